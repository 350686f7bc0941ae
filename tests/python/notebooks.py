"""Runs the notebooks of tools/notebooks as a reader would, cell by cell in a kernel of its own.

    notebooks.py [--draw]        with this Python: --draw keeps what the cells show in the notebooks
    notebooks.py --wheel [DIST]  in a new environment with the wheel of DIST (dist), where WARMJOINT_NOTEBOOKS is set; else skipped (77)

Needs nbclient and ipykernel; --wheel fetches them into the new environment. A notebook that takes two minutes of the processor or more fails.
"""

import os
import pathlib
import resource
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
NOTEBOOKS = sorted((ROOT / "tools/notebooks").glob("*.ipynb"))
LIMIT = 120  # s
NEEDED = ["mujoco==4.0.*", "nbclient", "nbformat", "ipykernel"]


def processor_time():
    """What processes have taken that this one started, s; a machine that does other things as well adds nothing."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def execute(path, draw):
    """Runs one notebook in an empty folder; a cell that raises ends this."""
    import nbclient
    import nbformat

    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    before = processor_time()
    with tempfile.TemporaryDirectory() as folder:
        nbclient.NotebookClient(notebook, timeout=5 * LIMIT, resources={"metadata": {"path": folder}}).execute()
    seconds = processor_time() - before
    print(f"{path.name}: {seconds:.0f} s of the processor")
    if seconds >= LIMIT:
        sys.exit(f"{path.name} took {seconds:.0f} s of the processor, not below {LIMIT}")
    if draw:
        for cell in notebook.cells:
            cell.metadata.pop("execution", None)  # times, which differ in every run
        notebook.metadata = {"kernelspec": notebook.metadata.kernelspec, "language_info": {"name": "python"}}
        nbformat.write(notebook, path)


def in_a_new_environment(dist):
    """This script again, by a Python that has nothing but the wheel and what runs notebooks."""
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    wheels = [*dist.glob(f"warmjoint-*-{version}-{version}-*.whl"), *dist.glob("warmjoint-*-abi3-*.whl")]
    if not wheels:
        sys.exit(f"{dist} holds no wheel for {version}: tools/python/wheel {dist}")
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-m", "venv", folder], check=True)
        python = pathlib.Path(folder) / "bin/python"
        subprocess.run([python, "-m", "pip", "install", "-q", wheels[0], *NEEDED], check=True)
        clean = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        subprocess.run([python, __file__], check=True, env=clean, cwd=folder)


def main():
    if "--wheel" in sys.argv:
        if not os.environ.get("WARMJOINT_NOTEBOOKS"):
            print("skipped: WARMJOINT_NOTEBOOKS=1 runs the notebooks in a new environment, with a wheel")
            sys.exit(77)
        in_a_new_environment(pathlib.Path(next(iter(sys.argv[2:]), ROOT / "dist")))
        return
    for path in NOTEBOOKS:
        execute(path, "--draw" in sys.argv)


if __name__ == "__main__":
    main()
