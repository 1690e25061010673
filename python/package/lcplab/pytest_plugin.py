"""Receipts in pytest: the fixture ``lcplab_receipts``, a table at the end, and a baseline.

>>> def test_stack_is_solved(lcplab_receipts):  # doctest: +SKIP
...     for _ in range(1000):
...         before = (data.qpos.copy(), data.qvel.copy())
...         mujoco.mj_step(model, data)
...         lcplab_receipts(model, data, before=before, every=10)

A test fails if one of its steps is rejected and the file of ``--lcplab-baseline`` does not list it. The session fails if too
little was checked, steps or checks of the baseline are missing, or the errors are larger than the baseline's. If only some of
the tests run (``-k``, ``-m``, a file or a test as argument), the steps of other tests may be missing. With ``--lcplab-update``
nothing fails, and the file is written.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

from lcplab._lcplab import InputError
from lcplab._receipt import Adapter, Receipt, Run, State, receipt
from lcplab._receipt.findings import STAGES
from lcplab._receipt.runs import load


class Session:
    """The receipts of all tests, by the names of tests and the number of the step."""

    def __init__(self, config: pytest.Config) -> None:
        self.receipts: dict[str, Receipt] = {}
        self.tests: set[str] = set()
        self.has_all_tests = not any("::" in name or name.endswith(".py") for name in config.args)
        #: Without xdist, whose workers have sessions of their own.
        self.is_complete = not (config.option.collectonly or getattr(config.option, "numprocesses", None))
        self.path: str | None = config.getoption("lcplab_baseline")
        self.is_update = bool(config.getoption("lcplab_update"))
        self.out: str | None = config.getoption("lcplab_out")
        has_baseline = self.path is not None and not self.is_update
        try:
            self.baseline = load(self.path) if has_baseline else None
        except InputError as error:
            raise pytest.UsageError(f"{error} (--lcplab-update records one)") from error

    @property
    def is_in_use(self) -> bool:
        """Whether tests asked for receipts, or a complete run is to be compared with a baseline."""
        return bool(self.tests) or (self.baseline is not None and self.has_all_tests and self.is_complete)

    def run(self) -> Run:
        """The run of all receipts."""
        return Run(self.receipts, self.baseline if self.has_all_tests else self._of_tests())

    def _of_tests(self) -> tuple[str, str] | None:
        """The baseline without the steps of tests that did not run."""
        if self.baseline is None:
            return None
        name, text = self.baseline
        recorded = json.loads(text)
        steps = recorded["errors"].items()
        recorded["errors"] = {step: error for step, error in steps if _test_of(step) in self.tests}
        unchecked = recorded["solver_unchecked"]
        recorded["solver_unchecked"] = [step for step in unchecked if _test_of(step) in self.tests]
        return name, json.dumps(recorded)


def _test_of(step: str) -> str:
    """The test of a step, by its name."""
    return step.rpartition(" step ")[0]


class Recorder:
    """The receipts of one test: call it after each step."""

    def __init__(self, session: Session, test: str) -> None:
        self.session, self.test = session, test
        session.tests.add(test)
        self.calls = 0
        self.receipts: dict[str, Receipt] = {}

    def __call__(
        self,
        model: Any,
        data: Any = None,
        *,
        every: int = 1,
        adapter: Adapter | None = None,
        before: State | None = None,
        limit: float | None = None,
    ) -> Receipt | None:
        """The receipt of this step, or None; every ``every``-th call has one, beginning with the first."""
        self.calls += 1
        if (self.calls - 1) % every:
            return None
        own = receipt(model, data, adapter=adapter, before=before, limit=limit)
        name = f"{self.test} step {self.calls}"
        self.receipts[name] = self.session.receipts[name] = own
        return own

    def new(self) -> list[str]:
        """The rejected steps that the baseline does not list."""
        run = Run(self.receipts, self.session.baseline)
        return [] if self.session.is_update else [name for name in run.rejected if name not in run.known]


SESSION = pytest.StashKey[Session]()
RECORDER = pytest.StashKey[Recorder]()


def pytest_addoption(parser: pytest.Parser) -> None:
    """The options."""
    group = parser.getgroup("lcplab", "receipts of a physics engine's steps")
    group.addoption("--lcplab-baseline", metavar="FILE", help="recorded run; steps that it lists as rejected do not fail")
    group.addoption("--lcplab-update", action="store_true", help="write this run to the file of --lcplab-baseline")
    group.addoption("--lcplab-out", metavar="FOLDER", help="write a folder for each of the ten worst rejected or unconverged steps")


def pytest_configure(config: pytest.Config) -> None:
    """Read the baseline."""
    if config.getoption("lcplab_update") and not config.getoption("lcplab_baseline"):
        raise pytest.UsageError("--lcplab-update needs --lcplab-baseline")
    config.stash[SESSION] = Session(config)


def pytest_deselected(items: Sequence[pytest.Item]) -> None:
    """Note that some tests do not run."""
    for item in items[:1]:
        item.config.stash[SESSION].has_all_tests = False


@pytest.fixture
def lcplab_receipts(request: pytest.FixtureRequest) -> Iterator[Recorder]:
    """A function of ``(model, data, every=1)`` to call after each step; it returns the receipt, or None."""
    recorder = Recorder(request.config.stash[SESSION], request.node.nodeid)
    request.node.stash[RECORDER] = recorder
    yield recorder
    errors = [own.motion_error for own in recorder.receipts.values() if own.motion_error is not None]
    request.node.user_properties.append(("lcplab_steps", len(recorder.receipts)))
    request.node.user_properties.append(("lcplab_largest_motion_error", max(errors, default=0.0)))


@pytest.hookimpl(wrapper=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> Iterator[None]:
    """Fail a test if the baseline does not list all of its rejected steps."""
    result = yield
    recorder = pyfuncitem.stash.get(RECORDER, None)
    new = recorder.new() if recorder else []
    if recorder and new:
        worst = "\n".join(f"{name}\n{recorder.receipts[name]}" for name in new[:3])
        stages = ", ".join(stage for stage in STAGES if any(recorder.receipts[name].stage == stage for name in new))
        count = f"{len(new)} of {len(recorder.receipts)} steps rejected at {stages}"
        pytest.fail(f"{count}\n{worst}", pytrace=False)
    return result


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Write the baseline and the worst steps; fail if the run as a whole is not ok."""
    own = session.config.stash[SESSION]
    if not own.is_in_use:
        return
    run = own.run()
    if own.is_update and own.path is not None:
        run.save(own.path)
    if own.out is not None:
        run.save_worst(Path(own.out))
    if not run.ok and not own.is_update and session.exitstatus == pytest.ExitCode.OK:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    """One table of all receipts."""
    own = config.stash[SESSION]
    if own.is_in_use:
        terminalreporter.section("lcplab receipts")
        terminalreporter.write_line(str(own.run()))
