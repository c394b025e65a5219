"""The models every test of the energies runs through."""

from dataclasses import asdict

from materials import COMPOUNDS, ArrudaBoyce, NeoHooke, Ogden, VanDerWaals

MODELS = {
    "neo-hooke": NeoHooke(G=0.7),
    "van-der-waals-mixed": VanDerWaals(G=0.7, lambda_m=4.0, a=0.4, beta=0.3),
    "arruda-boyce": ArrudaBoyce(C1=0.5, lambda_m=3.0),
    "ogden": Ogden(mu=(0.4, 0.01, 0.05), alpha=(1.3, 5.0, -2.0)),
    **COMPOUNDS,
}


def constants(model):
    """Constants of a model as the reference solutions take them."""
    return asdict(model)


def kind(model):
    return type(model).__name__
