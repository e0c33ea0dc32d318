"""The package as such: its stubs, its documentation, sweeps, the worked example."""

import ast
import inspect
import json
import pathlib
import re
import subprocess
import sys

import quadrel
from quadrel import _quadrel, quad, sample

PROJECT = pathlib.Path(__file__).parents[2]
PACKAGE = pathlib.Path(quadrel.__file__).parent


def declared():
    """Names of the stub with the parameters of functions."""
    found = {}
    for node in ast.parse((PACKAGE / "_quadrel.pyi").read_text()).body:
        if isinstance(node, ast.FunctionDef):
            found[node.name] = [argument.arg for argument in node.args.args]
        elif isinstance(node, ast.ClassDef):
            found[node.name] = {member.name if isinstance(member, ast.FunctionDef)
                                else member.target.id for member in node.body
                                if isinstance(member, (ast.FunctionDef, ast.AnnAssign))}
        elif isinstance(node, ast.AnnAssign):
            found[node.target.id] = None
    return found


def test_stubs_say_what_the_module_has():
    stubs = declared()
    names = {name for name in vars(_quadrel) if not name.startswith("_")}
    assert names == set(stubs)
    for name, parameters in stubs.items():
        member = getattr(_quadrel, name)
        if isinstance(parameters, list):
            signature = re.match(rf"{name}\((.*)\) -> ", member.__doc__).group(1)
            signature = re.sub(r"\[[^\[\]]*(\[[^\[\]]*\])*[^\[\]]*\]", "", signature)
            assert [p.split(":")[0].strip() for p in signature.split(", ")] == parameters, name
        elif isinstance(parameters, set) and not issubclass(member, BaseException):
            own = {n for n in vars(member) if not n.startswith("_")}
            assert own == parameters - {"__init__"}, name
    assert (PACKAGE / "py.typed").exists()


def test_all_that_is_public_is_documented():
    for module in (quadrel, quad, sample):
        names = getattr(module, "__all__", None) or \
            [n for n, v in vars(module).items() if getattr(v, "__module__", "") == module.__name__]
        for name in names:
            member = getattr(module, name)
            if name.startswith("_"):
                continue
            assert inspect.getdoc(member), name
            if inspect.isclass(member):
                for method, value in vars(member).items():
                    if inspect.isfunction(value) and not method.startswith("_"):
                        assert inspect.getdoc(value), f"{name}.{method}"


def test_the_version_is_the_projects():
    text = (PROJECT / "CMakeLists.txt").read_text()
    assert quadrel.__version__ == re.search(r"project\(Quadrel\s+VERSION (\S+)", text).group(1)
    project = (PROJECT / "src/python/pyproject.toml").read_text()
    assert f'version = "{quadrel.__version__}"' in project


def test_sweeps_measure_what_a_plan_says(tmp_path):
    plan = tmp_path / "plan.json"
    plan.write_text(json.dumps({
        "sweep": 1, "title": "two searches", "scenes": [{"name": "bricks", "scene": "bricks-45"}],
        "views": [45], "algorithms": [{"trace": "linear"}, {"trace": "max-mip"}],
        "size": [16, 16], "repeats": 1}))
    shares = []
    runs = quadrel.sweep(plan, tmp_path / "out", progress=shares.append)
    assert [run["trace"] for run in runs] == ["linear", "max-mip"] and shares[-1] == 1
    assert all("failed" not in run for run in runs)
    assert (tmp_path / "out" / "page.html").exists()
    half = quadrel.sweep(plan, tmp_path / "out", task=(2, 2))
    assert [run["trace"] for run in half] == ["max-mip"]
    assert half[0]["key"] == runs[1]["key"]


def run_example(*arguments):
    return subprocess.run([sys.executable, PROJECT / "src/python/first_wrong_value.py", *arguments],
                          capture_output=True, text=True)


def test_the_worked_example_finds_the_first_wrong_value(tmp_path):
    ran = run_example()
    assert ran.returncode == 1, ran.stderr
    assert re.search(r"The first wrong value at \d+,\d+ is dUVdy\.[UV]", ran.stdout), ran.stdout
    assert "all is right" in ran.stdout


def test_the_readmes_example_runs(tmp_path, monkeypatch):
    """What README.md shows of Python, line by line."""
    monkeypatch.chdir(tmp_path)
    text = (PROJECT / "README.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert blocks
    for block in blocks:
        exec(compile(block, "README.md", "exec"), {})
    assert (tmp_path / "bricks.exr").exists()
