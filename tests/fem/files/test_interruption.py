"""Requests to end: where they raise, where they wait, where they are only noted."""

from __future__ import annotations

import importlib
import signal
import sys
import threading
import time

import pytest

from fem.files.interruption import SIGNALS, at_step_ends, deferring, gently, listening, requested


def ask(number: int = signal.SIGTERM, times: int = 1) -> None:
    for _ in range(times):
        signal.raise_signal(number)


@pytest.mark.parametrize("number", SIGNALS)
def test_every_request_raises_where_the_program_stands(number):
    with listening():
        assert not requested()
        with pytest.raises(KeyboardInterrupt):
            ask(number)
        assert requested()


def test_requests_in_quick_succession_are_one():
    with listening():
        with pytest.raises(KeyboardInterrupt):
            ask()
        for _ in range(7):
            ask()


def test_gently_they_are_noted_only():
    with listening(), gently():
        for _ in range(8):
            ask()
        assert requested()


def test_between_steps_the_second_one_raises_once():
    with listening(), gently():
        with pytest.raises(KeyboardInterrupt), at_step_ends():
            ask(times=2)
        for _ in range(6):
            ask()


def test_deferred_they_act_at_the_end():
    done = []

    def write() -> None:
        with deferring():
            ask()
            done.append("written")
        done.append("never")

    with listening(), pytest.raises(KeyboardInterrupt):
        write()
    assert done == ["written"]


def test_deferred_within_gently_they_stay_noted():
    with listening(), gently():
        with deferring():
            ask()
        assert requested()


def test_handlers_come_back_and_an_ignored_signal_stays_ignored():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        own = [signal.getsignal(number) for number in SIGNALS]
        with listening():
            ask(signal.SIGHUP)
            assert not requested()
        assert [signal.getsignal(number) for number in SIGNALS] == own
    finally:
        signal.signal(signal.SIGHUP, before)


def test_in_another_thread_nothing_is_changed():
    found = []

    def work() -> None:
        with listening(), gently(), at_step_ends(), deferring():
            found.append(signal.getsignal(signal.SIGTERM))

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert found == [signal.getsignal(signal.SIGTERM)]


def test_request_during_an_import_waits_until_the_module_is_whole(tmp_path, monkeypatch):
    (tmp_path / "slow_module.py").write_text(
        "import signal\nbefore = 1\nsignal.raise_signal(signal.SIGTERM)\nafter = 2\n"
    )
    monkeypatch.syspath_prepend(str(tmp_path))

    def load_and_work():
        importlib.import_module("slow_module")
        time.sleep(10.0)

    with listening(), pytest.raises(KeyboardInterrupt):
        load_and_work()
    # An import that was interrupted leaves no module.
    assert sys.modules.pop("slow_module").after == 2
