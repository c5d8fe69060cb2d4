"""The examples for clusters in docs/cluster: what parses them here, and what they name is there."""

import shutil
import subprocess
from pathlib import Path

import pytest
import yaml
from accelerate.commands.config.config_args import load_config_from_file

from src.train.train_generation import app

FOLDER = Path(__file__).parents[1] / "docs" / "cluster"


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
def test_slurm() -> None:
    script = FOLDER / "slurm.sh"
    subprocess.run(["bash", "-n", str(script)], check=True)
    assert "src.train.train_generation" in script.read_text() and app


def test_kubernetes() -> None:
    service, job = yaml.safe_load_all((FOLDER / "kubernetes.yaml").read_text())
    assert job["spec"]["completionMode"] == "Indexed"
    pod = job["spec"]["template"]["spec"]
    assert pod["subdomain"] == service["metadata"]["name"]
    arguments = pod["containers"][0]["args"]
    assert f"--nnodes={job['spec']['completions']}" in arguments
    host = f"{job['metadata']['name']}-0.{pod['subdomain']}"
    assert f"--master-addr={host}" in arguments
    mounts = {mount["name"] for mount in pod["containers"][0]["volumeMounts"]}
    assert mounts == {volume["name"] for volume in pod["volumes"]}


def test_accelerate() -> None:
    config = load_config_from_file(str(FOLDER / "fsdp2.yaml"))
    assert config.distributed_type == "FSDP" and config.fsdp_config == {"fsdp_version": 2}
