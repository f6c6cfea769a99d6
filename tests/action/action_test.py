"""The action in a repository of somebody else, from nothing: `gnomon init`, references, a shader that
becomes worse, and the command that accepts it."""

import json
import os
import pathlib
import shlex
import subprocess
import time

import pytest
from run_action import run_action, workflow_inputs

PROJECT = pathlib.Path(os.environ["GNOMON_PROJECT"])
PROGRAM = pathlib.Path(os.environ["GNOMON_PROGRAM"])
SHADER = "shadows/my-shadow.glsl"
ACTION = "somebody/gnomon@v0.1.0"


class Repository:
    def __init__(self, folder, home):
        self.folder = folder
        self.environment = {
            "PATH": f"{PROGRAM.parent}:{os.environ['PATH']}",
            "GNOMON_CACHE": str(home / "cache"),
            "GITHUB_STEP_SUMMARY": str(home / "summary.md"),
            "GITHUB_SHA": "",
        }
        self.call("git", "init", "--quiet")
        self.call("gnomon", "init", "--action", ACTION)
        self.commit("the starter")

    def call(self, *words):
        return subprocess.run(
            words, cwd=self.folder, env={**os.environ, **self.environment},
            capture_output=True, text=True, check=True,
        ).stdout  # fmt: skip

    def commit(self, text):
        self.call("git", "add", "--all")
        who = ["-c", "user.name=a", "-c", "user.email=a@example.com"]
        self.call("git", *who, "commit", "--quiet", "--message", text)

    def accept(self, command, reason):
        """The command as the summary has it, with a reason."""
        self.call(*[reason if word == "why" else word for word in shlex.split(command)])
        self.commit(reason)

    def action(self):
        inputs = workflow_inputs(self.folder / ".github/workflows/shadows.yml", ACTION)
        return run_action(PROJECT, self.folder, inputs, self.environment)

    def make_worse(self):
        file = self.folder / SHADER
        text = file.read_text()
        assert "> bias" in text
        file.write_text(text.replace("> bias", "> bias - 0.03"))

    def history(self):
        return json.loads((self.folder / "shadows/references/shadows.json").read_text())["history"]


@pytest.fixture(name="repository")
def starter(tmp_path):
    (tmp_path / "repository").mkdir()
    repository = Repository(tmp_path / "repository", tmp_path)
    first = run_action(PROJECT, repository.folder, {"studies": "shadows/shadows.toml"},
                       repository.environment)  # fmt: skip
    assert first[0] == 3, "without references nothing is judged"
    accept = accept_command(first[2])
    repository.accept(accept, "first references")
    return repository


def accept_command(summary):
    return summary.split("run this and commit its files:\n\n```\n")[1].split("\n```")[0]


def test_passes_while_nothing_changes(repository):
    status, output, summary = repository.action()
    assert status == 0, output
    assert "::error" not in output
    assert summary.startswith("## Shadows: pass\n")


def test_gates_the_own_method_alone(repository):
    """A release of Gnomon whose `onoue-2004` is another keeps nobody's build from passing."""
    references = repository.folder / "shadows/references/shadows.json"
    values = json.loads(references.read_text())
    for value in values["values"]:
        if value["method"] != "my-shadow" and value["metric"] == "error_rate":
            value["value"] = 0.001
    references.write_text(json.dumps(values))
    status, output, _ = repository.action()
    assert status == 0, output
    assert "Notice" not in output, "the starter's own limit is as tight as a check wants it"


def test_fails_at_the_shader_that_has_become_worse(repository):
    repository.make_worse()
    begin = time.monotonic()
    status, output, summary = repository.action()
    assert time.monotonic() - begin < 90
    assert status == 1, output
    errors = [line for line in output.splitlines() if line.startswith("::error ")]
    assert errors
    assert all(line.startswith(f"::error file={SHADER},title=shadows%3A reference") for line in errors)
    assert summary.startswith("## Shadows: fail\n")
    assert f"| {SHADER} |" in summary
    for title in ("Before", "After", "Change"):
        picture = summary.split(f"**{title}** (`")[1]
        assert (repository.folder / picture.split("`")[0]).is_file()
        assert picture.split("```\n")[1].count("\n") == 40
    assert "| my-shadow | error\\_rate |" in summary
    change = summary.split("**Change**")[1]
    assert "🟧" in change and "🟦" not in change, "shadows can only grow"
    assert "<failure" in (repository.folder / "shadows.xml").read_text()


def test_accepts_with_one_command(repository):
    repository.make_worse()
    repository.commit("a faster shader")
    head = repository.call("git", "rev-parse", "HEAD").strip()
    repository.accept(accept_command(repository.action()[2]), "a faster shader is worth it")
    assert repository.action()[0] == 0
    assert repository.history()[-1]["reason"] == "a faster shader is worth it"
    assert repository.history()[-1]["repository_commit"] == head
    assert len({entry["repository_commit"] for entry in repository.history()}) == 2


def test_marks_the_line_of_an_error_in_the_shader(repository):
    file = repository.folder / SHADER
    file.write_text(file.read_text().replace("bias;", "bais;"))
    status, output, _ = repository.action()
    assert status == 3, output
    assert f"::error file={SHADER},line=" in output


def init(folder, *words):
    words = [PROGRAM, "init", *words, "--action", ACTION]
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)


def test_a_starter_overwrites_nothing(tmp_path):
    kept = tmp_path / SHADER
    kept.parent.mkdir()
    kept.write_text("mine")
    outcome = init(tmp_path)
    assert outcome.returncode == 3
    assert outcome.stderr == f"gnomon: ./{SHADER}: is there already; nothing was written\n"
    assert [path for path in tmp_path.rglob("*") if path.is_file()] == [kept]
    assert kept.read_text() == "mine"


def test_a_starter_says_what_to_do_next(tmp_path):
    outcome = init(tmp_path, "new folder")
    assert outcome.returncode == 0, outcome.stderr
    lines = outcome.stdout.splitlines()
    files = [line for line in lines if line.startswith("new folder/")]
    written = [path for path in (tmp_path / "new folder").rglob("*") if path.is_file()]
    assert sorted(files) == sorted(str(path.relative_to(tmp_path)) for path in written)
    assert "Next, in 'new folder':" in lines
    assert init(tmp_path, "new folder").returncode == 3


def test_a_starter_asks_whose_action_it_calls(tmp_path):
    def outcome(*words):
        return subprocess.run([PROGRAM, "init", *words], cwd=tmp_path, capture_output=True, text=True, check=False)

    for words in ([], ["--action", "gnomon"], ["--action", "a/b@v1 # c"]):
        refused = outcome(*words)
        assert refused.returncode == 2
        assert "OWNER/NAME@VERSION expected" in refused.stderr
        assert not list(tmp_path.iterdir())
    assert outcome("plain", "--action", "none").returncode == 0
    assert not (tmp_path / "plain/.github").exists()
    assert outcome("whole", "--action", ACTION).returncode == 0
    workflow = (tmp_path / "whole/.github/workflows/shadows.yml").read_text()
    assert f"uses: {ACTION}" in workflow and "OWNER" not in workflow


def test_a_starter_that_cannot_be_written_is_told_in_one_line(tmp_path):
    (tmp_path / "file").write_text("")
    outcome = init(tmp_path, "file")
    assert outcome.returncode == 3
    assert outcome.stderr.count("\n") == 1
