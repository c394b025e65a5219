"""Physical constants, and units of measurement in those of the calculation: N, mm, s, t, K."""

#: Absolute zero [deg C].
ABSOLUTE_ZERO_C = -273.15
#: Stefan-Boltzmann constant, 5.670374419e-8 W/(m^2 K^4) (CODATA 2018) [N/(mm s K^4)].
STEFAN_BOLTZMANN = 5.670374419e-11
#: Density [t/mm^3].
KG_PER_M3 = 1e-12
#: Specific heat [mJ/(t K)].
KJ_PER_KG_K = 1e9
#: Conductance [N/(mm s K)].
W_PER_M2_K = 1e-3
#: Power [mJ/s], which is N mm/s.
WATT = 1e3
