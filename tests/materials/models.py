"""The models every test of the energies runs through."""

from dataclasses import asdict

from materials import COMPOUNDS, ArrudaBoyce, NeoHooke, VanDerWaals

MODELS = {
    "neo-hooke": NeoHooke(G=0.7),
    "van-der-waals-mixed": VanDerWaals(G=0.7, lambda_m=4.0, a=0.4, beta=0.3),
    "arruda-boyce": ArrudaBoyce(C1=0.5, lambda_m=3.0),
    **COMPOUNDS,
}


def constants(model):
    """Constants of a model as the reference solutions take them."""
    return asdict(model)


def kind(model):
    return type(model).__name__
