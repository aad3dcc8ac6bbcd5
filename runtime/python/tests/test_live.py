"""The page that answers while one edits, asked as the page asks."""

import json
import math
import time
import urllib.error
import urllib.request

import pytest

import eigentol

BOB = """mechanism Bob {
    input tilt: deg;
    design l = 1 m +/- 1%;
    gravity 9.81 m/s^2 along -z;
    body bar: rod(mass: 1 kg, length: l, along: -z);
    joint theta: revolute(y) from ground to bar;
}"""


def asked(live, question, **given):
    body = json.dumps({"ask": question, "given": given}).encode()
    request = urllib.request.Request(live.address + "answer", body, method="POST")
    for _ in range(200):
        with urllib.request.urlopen(request, timeout=60) as response:
            last = json.loads(response.read().decode().splitlines()[-1])
        if "no machine yet" not in last.get("refused", ""):
            return last
        time.sleep(0.05)
    raise AssertionError("the declaration is never read")


def frequency(live, **given):
    return asked(live, "at_point", **given)["answer"]["sections"]["slopes"]["modes"][0]["frequency"]


def test_the_page_answers_as_the_study_does():
    mechanism = eigentol.Mechanism.from_text(BOB)
    study = eigentol.Study(mechanism, design={"l": "2 m"}, tolerances={"l": 0.02})
    with study.live() as live:
        assert live.address.startswith("http://127.0.0.1:")
        assert live.address in live._repr_html_()
        with urllib.request.urlopen(live.address) as page:
            assert "<main>" in page.read().decode()
        expected = study.modes().frequencies[0]
        unit = asked(live, "at_point")["answer"]["sections"]["slopes"]["unit"]
        scale = {"Hz": 2 * math.pi, "rad/s": 1.0}[unit]
        assert math.isclose(scale * frequency(live), expected, rel_tol=1e-9)
        moved = study.replace(design={"l": "50 cm"}).modes().frequencies[0]
        assert math.isclose(scale * frequency(live, set={"l": "50 cm"}), moved, rel_tol=1e-9)
        text = asked(live, "study")["answer"]["file"]["text"]
        assert 'l = "2 m"' in text and 'l = "0.02 m"' in text
        with pytest.raises(urllib.error.HTTPError):
            urllib.request.urlopen(live.address.replace("127.0.0.1", "127.0.0.1")[:-2] + "/")
    with pytest.raises(OSError):
        urllib.request.urlopen(live.address, timeout=5)


def test_the_page_follows_a_file(tmp_path):
    file = tmp_path / "bob.mechanism"
    file.write_text(BOB)
    live = eigentol.Mechanism.from_file(file).live(design={"l": "2 m"})
    first = frequency(live)
    file.write_text(BOB.replace("9.81", "39.24"))
    for _ in range(200):
        if math.isclose(frequency(live), 2 * first, rel_tol=1e-9):
            break
        time.sleep(0.05)
    else:
        raise AssertionError("the page does not follow the file")
    live.stop()
    live.stop()


def test_a_port_in_use_is_refused():
    live = eigentol.Mechanism.from_text(BOB).live()
    port = int(live.address.split(":")[2].split("/")[0])
    with pytest.raises(OSError, match=f"cannot listen on port {port}"):
        eigentol.Study(eigentol.Mechanism.from_text(BOB)).live(port=port)
