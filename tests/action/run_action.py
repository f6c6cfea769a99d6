"""Runs the steps of a composite action as GitHub's runner does, as far as this one uses them: inputs,
`env`, `run` in a shell, a file for the job summary. Steps that use other actions are named only."""

import os
import pathlib
import re
import subprocess

import yaml


def workflow_inputs(workflow, action):
    """The `with` of the step of a workflow that uses an action, by a part of its name."""
    jobs = yaml.safe_load(pathlib.Path(workflow).read_text())["jobs"].values()
    steps = [step for job in jobs for step in job["steps"] if action in step.get("uses", "")]
    assert len(steps) == 1, f"{workflow}: {len(steps)} steps use {action}, one expected"
    return steps[0].get("with", {})


def run_action(action, workspace, inputs, environment):
    """Returns the exit status of the first step that failed, all output, and the job summary."""
    action = pathlib.Path(action)
    description = yaml.safe_load((action / "action.yml").read_text())
    unknown = set(inputs) - set(description["inputs"])
    assert not unknown, f"the action has no inputs {unknown}"
    values = {name: entry.get("default", "") for name, entry in description["inputs"].items()}
    values.update(inputs)

    def filled(text):
        return re.sub(r"\$\{\{ *inputs\.([a-z-]+) *\}\}", lambda found: values[found[1]], text)

    summary = pathlib.Path(environment["GITHUB_STEP_SUMMARY"])
    summary.write_text("")
    output, status = "", 0
    for step in description["runs"]["steps"]:
        if "uses" in step:
            assert re.search(r"@v\d+$", step["uses"]), f"{step['uses']}: a version expected"
            continue
        if status != 0 and step.get("if") != "always()":
            continue
        # As the runner calls `shell: sh`.
        process = subprocess.run(
            ["sh", "-e", "-c", step["run"]],
            cwd=workspace,
            env={**os.environ, **environment, "GITHUB_ACTION_PATH": str(action),
                 **{name: filled(text) for name, text in step.get("env", {}).items()}},
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
        )  # fmt: skip
        output += process.stdout
        status = status or process.returncode
    return status, output, summary.read_text()
