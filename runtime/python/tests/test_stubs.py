"""The stubs: mypy finds them sound, and what they say is what the module has."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import eigentol

pytest.importorskip("mypy", reason="mypy is absent: the stubs are not checked")

TYPED = """
import eigentol
import numpy as np
from numpy.typing import NDArray

mechanism = eigentol.Mechanism.from_file("rotor.mechanism")
study = eigentol.Study(mechanism, inputs={"speed": "3000 rpm"}, samples=500)
frequencies: NDArray[np.float64] = study.modes().frequencies
assembly: eigentol.Answer = study.assembly()
chances: eigentol.Answer = study.chances(["frequency 1 >= 3 rad/s", "stable"], 0, 100)
names: list[str] = study.campbell("speed", [1.0, 2.0]).tables
table: dict[str, object] = study.first_order().table()
text: str = study.summary().to_json() + study.equilibrium()._repr_html_()
"""

WRONG = {
    "samples='many'": "eigentol.Study(mechanism, samples='many')",
    "a name that no result has": "study.modes().frequency",
    "a policy that is none": "eigentol.Study(mechanism, policy='unstable')",
    "text for a number": "study.samples_between('0', 1)",
}


def mypy(tmp_path, text):
    script = tmp_path / "script.py"
    script.write_text(text)
    command = [sys.executable, "-m", "mypy", "--strict", "--no-incremental", str(script)]
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    return run.returncode, run.stdout + run.stderr


def test_a_typed_script_is_right(tmp_path):
    code, said = mypy(tmp_path, TYPED)
    assert code == 0, said


@pytest.mark.parametrize("what", WRONG)
def test_a_wrong_one_is_not(tmp_path, what):
    code, said = mypy(tmp_path, TYPED + WRONG[what] + "\n")
    assert code == 1, said
    last = len(TYPED.splitlines()) + 1
    errors = [line for line in said.splitlines() if ": error: " in line]
    assert errors and all(f"script.py:{last}:" in line for line in errors), said


def stub():
    return Path(eigentol.__file__).with_name("__init__.pyi").read_text()


def test_stubs_say_what_the_module_has(tmp_path):
    # Names of types, which the module has no use for.
    aliases = re.findall(r"^(\w+): TypeAlias", stub(), re.MULTILINE)
    allowed = tmp_path / "allowed"
    # What looks up fields is known by another name at run time.
    aliases.append("Answer.__getattr__")
    allowed.write_text("".join(f"eigentol.{name}\n" for name in aliases))
    options = ["--ignore-missing-stub", "--allowlist", str(allowed)]
    command = [sys.executable, "-m", "mypy.stubtest", "eigentol", *options]
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr


def test_every_public_name_has_a_stub():
    text = stub()
    missing = [name for name in dir(eigentol) if not name.startswith("_") and name not in text]
    assert missing in ([], ["eigentol"]), missing
