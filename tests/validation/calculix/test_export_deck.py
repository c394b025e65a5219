"""Input decks: geometry, sets, material and loads read back from the text."""

from __future__ import annotations

import numpy as np
import pytest

import treadfem
from fem.case.case import Case
from fem.case.errors import CaseError
from fem.mechanics import BlockMechanics
from fem.simulation import coupled_model
from fem.stepping.model_parts import mesh_of
from tests.validation.deck_reading import FACES, named, node_set, nodes, read_deck
from tests.validation.sliding_cases import sliding_case
from validation.calculix.deck_event import top_loads
from validation.calculix.deck_mesh import half_slab
from validation.calculix.export_deck import DeckOptions, friction_remark, input_deck

MOONEY = {"compound": "mooney-rivlin-dumbbells"}
NEO_HOOKE = {"model": "neo-hooke", "G_N_per_mm2": 0.8}
OGDEN = {"model": "ogden", "mu_N_per_mm2": [0.7, 0.1], "alpha": [1.3, -2.0]}


def with_rubber(**rubber) -> Case:
    tables = {**sliding_case().to_dict(), "rubber": {**rubber, "bulk_ratio": 80.0}}
    return Case.from_dict(tables)


def brick_corners(cards, elset):
    place = nodes(cards)
    rows = named(cards, "ELEMENT", ELSET=elset).numbers
    return {int(row[0]): np.array([place[int(i)] for i in row[1:]]) for row in rows}


@pytest.mark.parametrize("velocity", [300.0, -300.0])
def test_bricks_are_right_handed_and_fill_the_block(velocity):
    case = sliding_case(loading__velocity_mm_per_s=velocity)
    cards = read_deck(input_deck(case))
    total = 0.0
    for x in brick_corners(cards, "RUBBER").values():
        volume = np.linalg.det([x[1] - x[0], x[3] - x[0], x[4] - x[0]])
        assert volume > 0.0
        total += volume
    assert total == pytest.approx(20.0 * 8.0 * 1.0, rel=1e-12)


@pytest.mark.parametrize("velocity", [300.0, -300.0])
def test_contact_faces_cover_bottom_and_both_ends_and_nothing_else(velocity):
    case = sliding_case(loading__velocity_mm_per_s=velocity)
    cards = read_deck(input_deck(case))
    bricks = brick_corners(cards, "RUBBER")
    lengths = {"bottom": 0.0, "ends": 0.0}
    for element, face in named(cards, "SURFACE", NAME="FREE").rows:
        x = bricks[int(element)][np.array(FACES[face]) - 1]
        if np.all(x[:, 1] == 0.0):
            lengths["bottom"] += np.ptp(x[:, 0])
        else:
            assert np.ptp(x[:, 0]) == 0.0
            assert x[0, 0] in (0.0, 20.0)
            lengths["ends"] += np.ptp(x[:, 1])
    assert lengths == pytest.approx({"bottom": 20.0, "ends": 16.0}, rel=1e-12)


@pytest.mark.parametrize("velocity", [300.0, -300.0])
def test_road_lies_under_the_whole_slide(velocity):
    cards = read_deck(input_deck(sliding_case(loading__velocity_mm_per_s=velocity)))
    ((element, face),) = named(cards, "SURFACE", NAME="ROADTOP").rows
    road = brick_corners(cards, "ROADBODY")[int(element)][np.array(FACES[face]) - 1]
    assert np.all(road[:, 1] == 0.0)
    reach = np.sign(velocity) * 2.0
    assert road[:, 0].min() < min(0.0, reach) - 2.0
    assert road[:, 0].max() > 20.0 + max(0.0, reach) + 2.0
    assert road[:, 2].min() < 0.0
    assert road[:, 2].max() > 1.0


def test_no_degree_of_freedom_is_prescribed_twice():
    """CalculiX stops (or worse, chooses) when an equation removes what is prescribed."""
    for options in (DeckOptions(), DeckOptions(bonded=True)):
        for top in ("platen", "pressure"):
            cards = read_deck(input_deck(sliding_case(loading__top=top), options))
            removed = [tuple(card.rows[1][:2]) for card in cards if card.name == "EQUATION"]
            assert len(set(removed)) == len(removed)
            held = {(str(i), "1") for i in node_set(cards, "HELD")}
            if options.bonded:
                held |= {(str(i), k) for i in node_set(cards, "GLUED") for k in "12"}
            assert not held & set(removed)


def test_equations_tie_equal_displacements_of_the_two_layers():
    cards = read_deck(input_deck(sliding_case()))
    place = nodes(cards)
    top = set(node_set(cards, "HELD"))
    for card in (card for card in cards if card.name == "EQUATION"):
        a, k, plus, b, same, minus = card.rows[1]
        assert (k, float(plus), float(minus)) == (same, 1.0, -1.0)
        both_on_top = {int(a), int(b)} <= top and k == "2"
        assert both_on_top or np.allclose(place[int(a)][:2], place[int(b)][:2])


def test_loads_are_those_of_the_simulation():
    case = sliding_case(block__mesh="coarse", loading__top="pressure")
    mechanics = coupled_model(case).mechanics
    assert isinstance(mechanics, BlockMechanics)
    force = np.zeros(len(mechanics.mesh.points))
    for line in top_loads(case, mesh_of(case)):
        node, component, value = line.split(",")
        assert int(component) == 2
        force[int(node) - 1] = float(value)
    np.testing.assert_allclose(force, -5.0 * mechanics.top_load, atol=1e-10)


@pytest.mark.parametrize(
    "rubber, keyword, constants",
    [
        (
            {"compound": "yeoh-bars-series-1-load"},
            "YEOH",
            [0.3794, 0.0232, -0.0003, 2.0 / (80.0 * 0.7588), 1e20, 1e20],
        ),
        (MOONEY, "MOONEY-RIVLIN", [0.2580, 0.4587, 2.0 / (80.0 * 1.4334)]),
        (NEO_HOOKE, "NEO HOOKE", [0.4, 2.0 / (80.0 * 0.8)]),
        (OGDEN, "OGDEN", [0.7, 1.3, 0.1, -2.0, 2.0 / (80.0 * 0.8), 1e20]),
    ],
)
def test_material_constants(rubber, keyword, constants):
    """U = (J - 1)^2/D1 is K/2 (J - 1)^2 for D1 = 2/K."""
    card = named(read_deck(input_deck(with_rubber(**rubber))), "HYPERELASTIC")
    assert next(iter(card.parameters)) == keyword
    (values,) = card.numbers
    assert values == pytest.approx(constants, rel=1e-11)


@pytest.mark.parametrize(
    "rubber, found",
    [
        ({"compound": "van-der-waals-bars-series-1"}, "VanDerWaals"),
        ({"model": "arruda-boyce", "C1_N_per_mm2": 0.3, "lambda_m": 3.0}, "ArrudaBoyce"),
    ],
)
def test_rubber_calculix_does_not_have_is_refused_in_one_line(rubber, found):
    with pytest.raises(CaseError) as caught:
        input_deck(with_rubber(**rubber))
    message = str(caught.value)
    assert found in message
    assert "CalculiX" in message
    assert caught.value.key == ("rubber.compound" if "compound" in rubber else "rubber.model")
    assert "\n" not in message


def test_rigid_block_is_refused():
    with pytest.raises(CaseError, match=r"block\.rigid"):
        input_deck(sliding_case(block__rigid=True))


def test_sliding_to_the_left_moves_the_platen_to_the_left():
    moves = {}
    for velocity in (300.0, -300.0):
        cards = read_deck(input_deck(sliding_case(loading__velocity_mm_per_s=velocity)))
        amplitude = named(cards, "AMPLITUDE", NAME="SLIDING").numbers[0]
        assert amplitude == [0.0, 0.0, 1.0, 0.0, 3.0, 2.0]
        ((name, first, last, factor),) = named(cards, "BOUNDARY", AMPLITUDE="SLIDING").rows
        assert (name, first, last) == ("HELD", "1", "1")
        moves[velocity] = float(factor)
    assert moves == {300.0: 1.0, -300.0: -1.0}


def test_coulomb_coefficient_is_exported_without_a_remark():
    text = input_deck(sliding_case())
    assert named(read_deck(text), "FRICTION").numbers[0][0] == 0.3
    assert "replaced" not in text
    assert friction_remark(sliding_case()) == ""


def test_frictionless_deck_has_no_friction():
    cards = read_deck(input_deck(sliding_case(friction__mu=0.0)))
    assert "FRICTION" not in {card.name for card in cards}


def test_other_friction_law_is_exported_as_a_constant_and_the_deck_says_so():
    tables = {**sliding_case().to_dict(), "friction": {"law": "huemer"}}
    case = Case.from_dict(tables)
    text = input_deck(case)
    mu = case.friction.law_object().coefficient(0.25, 300.0, 20.0)
    assert named(read_deck(text), "FRICTION").numbers[0][0] == pytest.approx(float(mu), rel=1e-11)
    assert f"** {friction_remark(case)}" in text.splitlines()
    assert "huemer" in friction_remark(case)


def test_bonded_deck_has_no_contact():
    cards = read_deck(input_deck(sliding_case(), DeckOptions(bonded=True)))
    assert not {"CONTACT PAIR", "FRICTION"} & {card.name for card in cards}
    assert ["GLUED", "1", "2"] in named(cards[: cards.index(named(cards, "STEP"))], "BOUNDARY").rows


# ------------------------------------------------------------------------------------- a slab

SLAB = DeckOptions(layers=half_slab(12.0, 3))


@pytest.fixture(scope="module")
def slab():
    return read_deck(input_deck(sliding_case(), SLAB))


def test_a_slab_has_a_brick_per_cell_and_layer_and_its_volume(slab):
    mesh, bricks = mesh_of(sliding_case()), brick_corners(slab, "RUBBER")
    assert len(bricks) == 3 * len(mesh.cells)
    sides = [np.array([x[1] - x[0], x[3] - x[0], x[4] - x[0]]) for x in bricks.values()]
    volumes = np.linalg.det(sides)
    assert volumes.min() > 0.0
    assert volumes.sum() == pytest.approx(20.0 * 8.0 * 6.0, rel=1e-12)


def test_node_sets_of_a_slab_are_where_they_should_be(slab):
    place, n = nodes(slab), len(mesh_of(sliding_case()).points)
    at = {
        name: np.array([place[i] for i in node_set(slab, name)])
        for name in ("TOP", "SURFACE", "GLUED", "HELD", "MIDDLE", "SIDE")
    }
    sizes = {name: len(x) for name, x in at.items()}
    assert sizes == {
        "TOP": 9, "SURFACE": 17, "GLUED": 36, "HELD": 36, "MIDDLE": n - 9, "SIDE": n
    }  # fmt: skip
    for name in ("TOP", "SURFACE", "MIDDLE"):
        assert np.all(at[name][:, 2] == 0.0)
    assert np.all(at["SIDE"][:, 2] == 6.0)
    for name, height in (("GLUED", 0.0), ("HELD", 8.0)):
        assert np.all(at[name][:, 1] == height)
        assert np.unique(at[name][:, 2]).tolist() == [0.0, 2.0, 4.0, 6.0]


def test_contact_faces_of_a_slab_cover_bottom_and_ends_over_its_depth(slab):
    bricks = brick_corners(slab, "RUBBER")
    area = {"bottom": 0.0, "ends": 0.0}
    for element, face in named(slab, "SURFACE", NAME="FREE").rows:
        x = bricks[int(element)][np.array(FACES[face]) - 1]
        size = np.linalg.norm(np.cross(x[1] - x[0], x[3] - x[0]))
        area["bottom" if np.all(x[:, 1] == 0.0) else "ends"] += size
    assert area == pytest.approx({"bottom": 120.0, "ends": 96.0}, rel=1e-12)


def test_the_road_reaches_beyond_the_free_side(slab):
    road = np.concatenate(list(brick_corners(slab, "ROADBODY").values()))
    assert road[:, 2].min() < 0.0
    assert road[:, 2].max() > 6.0


@pytest.mark.parametrize("top", ["platen", "pressure"])
def test_the_half_slab_carries_half_the_force_evenly_over_its_depth(top):
    case = sliding_case(loading__top=top)
    place = nodes(read_deck(input_deck(case, SLAB)))
    loads = [line.split(",") for line in top_loads(case, mesh_of(case), SLAB.layers)]
    per_layer = dict.fromkeys((0.0, 2.0, 4.0, 6.0), 0.0)
    for node, component, value in loads:
        assert int(component) == 2
        assert place[int(node)][1] == 8.0
        per_layer[place[int(node)][2]] += float(value)
    whole = -0.25 * 20.0 * 6.0
    expected = {0.0: whole / 6, 2.0: whole / 3, 4.0: whole / 3, 6.0: whole / 6}
    assert per_layer == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("top", ["platen", "pressure"])
@pytest.mark.parametrize("bonded", [False, True])
def test_only_a_platen_ties_nodes_of_a_slab(top, bonded):
    options = DeckOptions(layers=SLAB.layers, bonded=bonded)
    cards = read_deck(input_deck(sliding_case(loading__top=top), options))
    removed = [card.rows[1] for card in cards if card.name == "EQUATION"]
    held, leader = set(node_set(cards, "HELD")), node_set(cards, "TOP")[0]
    if top == "pressure":
        assert not removed
        return
    assert {int(row[0]) for row in removed} == held - {leader}
    assert {(row[1], int(row[3]), row[4]) for row in removed} == {("2", leader, "2")}


def test_a_slab_is_free_along_z_but_at_its_middle_and_its_platen(slab):
    fixed = named(slab[: slab.index(named(slab, "STEP"))], "BOUNDARY").rows
    assert fixed == [["MIDDLE", "3", "3"], ["HELD", "3", "3"], ["ROAD", "1", "3"]]
    heading = input_deck(sliding_case(), SLAB).split("*NODE")[0]
    assert "slab, 12 mm deep with free sides" in heading
    assert "z = 0 is a plane of symmetry, z = 6 is free" in heading
    assert "half" in heading


def test_a_slab_needs_constant_friction():
    case = Case.from_dict({**sliding_case().to_dict(), "friction": {"law": "huemer"}})
    with pytest.raises(CaseError, match=r"friction\.law: found \"huemer\""):
        input_deck(case, SLAB)


# ------------------------------------------------------------------------------ command line


def write_case(folder, rubber="yeoh-bars-series-1-load", law='law = "coulomb"\nmu = 0.3'):
    path = folder / "case.toml"
    path.write_text(
        f'[rubber]\ncompound = "{rubber}"\n[friction]\n{law}\n[loading]\n'
        "mean_pressure_N_per_mm2 = 0.25\nvelocity_mm_per_s = 300.0\ndistance_mm = 2.0\n"
    )
    return path


def test_command_writes_the_deck(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    path = write_case(tmp_path)
    assert treadfem.main(["export", str(path), "--format", "inp"]) == 0
    printed = capsys.readouterr()
    assert printed.out.split()[-1] == "case.inp"
    assert (tmp_path / "case.inp").read_text() == input_deck(Case.from_toml(path))
    assert treadfem.main(["export", str(path), "-o", "other.inp"]) == 0
    assert (tmp_path / "other.inp").read_text() == (tmp_path / "case.inp").read_text()


def test_command_says_what_it_replaced(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert treadfem.main(["export", str(write_case(tmp_path, law='law = "huemer"'))]) == 0
    assert "huemer replaced by a constant coefficient" in capsys.readouterr().err


@pytest.mark.parametrize("target", ["case.inp", "missing/case.inp", "."])
def test_command_refuses_in_one_line_and_writes_nothing(target, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    rubber = "van-der-waals-bars-series-1" if target == "case.inp" else "yeoh-bars-series-1"
    path = write_case(tmp_path, rubber=rubber)
    assert treadfem.main(["export", str(path), "-o", target]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert list(tmp_path.iterdir()) == [path]


def test_the_deck_of_a_siped_pair_of_blocks_has_all_curves_and_the_whole_force():
    """Faces of every wall are in the free surface; the load is that of both blocks."""
    sipe = {"position_mm": 10.0, "depth_mm": 6.0}
    case = with_rubber(**NEO_HOOKE).with_overrides(
        {"block.sipes": [sipe], "block.blocks": 2, "block.mesh": "coarse"}
    )
    mesh, cards = mesh_of(case), read_deck(input_deck(case))
    (surface,) = [card for card in cards if card.parameters.get("NAME") == "FREE"]
    assert len(surface.rows) == len(mesh.boundary_edges)
    np.testing.assert_array_equal(np.sort(node_set(cards, "SURFACE")), np.sort(mesh.boundary) + 1)
    loads = [float(line.split(",")[2]) for line in top_loads(case, mesh)]
    pressed = case.block.blocks * case.block.length_mm
    assert sum(loads) == pytest.approx(-case.loading.mean_pressure_N_per_mm2 * pressed, rel=1e-9)


def test_command_writes_a_slab(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = ["export", str(write_case(tmp_path)), "--set", "block.mesh=coarse"]
    assert treadfem.main([*words, "--depth-mm", "12", "--cells-z", "3"]) == 0
    case = Case.from_toml(tmp_path / "case.toml", {"block.mesh": "coarse"})
    assert (tmp_path / "case.inp").read_text() == input_deck(case, SLAB)


@pytest.mark.parametrize(
    "words, says",
    [
        ("--depth-mm 40", "--cells-z: found nothing"),
        ("--cells-z 4", "--depth-mm: found nothing"),
        ("--depth-mm 0 --cells-z 4", "--depth-mm: found 0, expected a depth above 0"),
        ("--depth-mm -1 --cells-z 4", "--depth-mm: found -1"),
        ("--depth-mm nan --cells-z 4", "--depth-mm: found nan"),
        ("--depth-mm inf --cells-z 4", "--depth-mm: found inf"),
        ("--depth-mm deep --cells-z 4", "argument --depth-mm: invalid float value: 'deep'"),
        ("--depth-mm 40 --cells-z 0", "--cells-z: found 0, expected at least 1 layer"),
        ("--depth-mm 40 --cells-z -3", "--cells-z: found -3"),
        ("--depth-mm 40 --cells-z 2.5", "argument --cells-z: invalid int value: '2.5'"),
        ("--depth-mm 40 --cells-z 9999999", "--cells-z: found 9999999, expected at most"),
    ],
)
def test_command_refuses_a_wrong_slab_in_one_line(words, says, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    path = write_case(tmp_path)
    try:
        code = treadfem.main(["export", str(path), *words.split()])
    except SystemExit as stop:
        code = stop.code
    said = capsys.readouterr().err
    assert code == 2
    assert says in said
    assert said.count("\n") == 1
    assert list(tmp_path.iterdir()) == [path]
