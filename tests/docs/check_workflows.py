"""Workflows, containers and what others read of the repository are as their formats ask.

    check_workflows.py ROOT

- What they call is there: scripts, Containerfiles, the folders that are copied. Actions of others are pinned by their commit.
- Their schemas hold, by check-jsonschema; zizmor finds nothing in the workflows.

Exits 77, with the reason, where PyYAML, check-jsonschema or zizmor is absent: pip install check-jsonschema zizmor. Nothing is run.
"""

import pathlib
import re
import shutil
import subprocess
import sys

try:
    import yaml
except ImportError:
    print("skipped: PyYAML is absent; tools/docs/setup fetches it")
    sys.exit(77)

SCHEMAS = {"vendor.github-workflows": ".github/workflows/*.yml", "vendor.readthedocs": ".readthedocs.yaml", "vendor.citation-file-format": "CITATION.cff"}
CALLED = re.compile(r"(?<![\w/.-])((?:tools|tests|\.ci)/[\w./-]+|\w*Containerfile)\b")


def commands(workflow):
    for job in workflow["jobs"].values():
        for step in job["steps"]:
            if "run" in step:
                yield step["run"]


def problems(root):
    for path in sorted(root.glob(".github/workflows/*.yml")):
        workflow = yaml.safe_load(path.read_text())
        if workflow.get("permissions") != {"contents": "read"}:
            yield f"{path.name}: permissions are not those of reading alone"
        for called in CALLED.findall("\n".join(commands(workflow))):
            if not (root / called).exists():
                yield f"{path.name}: calls {called}, which is not there"
        for action in re.findall(r"uses: *(\S+)", path.read_text()):
            if not re.search(r"@[0-9a-f]{40}$", action):
                yield f"{path.name}: {action} is not pinned by a commit"
    for called in CALLED.findall((root / ".readthedocs.yaml").read_text()):
        if not (root / called).exists():
            yield f".readthedocs.yaml: calls {called}, which is not there"
    for name, context in (("Containerfile", "."), ("tools/python/Containerfile", "tools")):
        for source in re.findall(r"^COPY (?!--from)(\S+)", (root / name).read_text(), re.M):
            if not (root / context / source).exists():
                yield f"{name}: copies {source}, which is not there"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    found = list(problems(root))
    if found:
        sys.exit("\n".join(found))
    if absent := [tool for tool in ("check-jsonschema", "zizmor") if not shutil.which(tool)]:
        print(f"skipped: {' and '.join(absent)} absent; pip install check-jsonschema zizmor")
        sys.exit(77)
    for schema, pattern in SCHEMAS.items():
        subprocess.run(["check-jsonschema", "--builtin-schema", schema, *root.glob(pattern)], check=True)
    subprocess.run(["zizmor", "--offline", "--no-progress", *root.glob(".github/workflows/*.yml")], check=True)


main()
