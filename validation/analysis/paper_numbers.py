"""Numbers that the paper prints about its own results, each with where it stands.

References
----------
.. [1] Hofstetter, K. et al., "Efficient treatment of rubber friction problems in industrial
   applications".
"""

#: Table 4 [kN]; its plane model has 1 m of depth, so the numbers are also N per mm.
PAPER_N_PER_MM = {
    "van-der-waals-bars-series-1": 4.56,
    "van-der-waals-bars-series-2": 4.10,
    "yeoh-bars-series-1": 4.54,
    "yeoh-bars-series-2": 4.32,
    "yeoh-bars-series-1-load": 4.86,
    "mooney-rivlin-dumbbells": 4.59,
}
#: Middle of the forces of Table 4 [N/mm].
MIDDLE_FORCE = 0.5 * (max(PAPER_N_PER_MM.values()) + min(PAPER_N_PER_MM.values()))
#: Range of the forces of Table 4 over their middle [-]. The paper calls these forces similar.
SIMILAR = (max(PAPER_N_PER_MM.values()) - min(PAPER_N_PER_MM.values())) / MIDDLE_FORCE
#: Deviation of the highest temperature that the paper accepts (section 5.2), upper end [K].
ACCEPTED_K = 2.0
#: To what the paper's temperatures could be measured (section 5.2), both ends [K].
MEASURED_TO_K = (0.5, 1.0)
#: Largest strain of the tests (section 2.2): dumbbells and both series of bars [-].
DUMBBELL_STRAIN, BAR_STRAIN = 0.40, {1: 1.5, 2: 3.0}
