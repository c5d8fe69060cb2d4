"""The examples for clusters in docs/cluster: what parses them here, and what they name is there."""

import os
import shlex
import shutil
import subprocess
from argparse import Namespace
from importlib.util import find_spec
from pathlib import Path

import pytest
import yaml
from accelerate.commands.config.config_args import load_config_from_file
from torch.distributed.run import parse_args

from src.shared.config_loader import load_train, split_network_overrides
from src.shared.config_schema import TrainGenerationConfig

FOLDER = Path(__file__).parents[1] / "docs" / "cluster"


@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
def test_slurm(tmp_path: Path) -> None:
    """Run with stand-ins for what SLURM and torch bring: both machines start the same training."""
    stand_ins = {
        "scontrol": "printf 'first\\nsecond\\n'",
        "srun": 'for node in 1 2; do "$@"; done',
        "torchrun": 'echo "$@"',
    }
    for name, does in stand_ins.items():
        (tmp_path / name).write_text(f"#!/bin/bash\n{does}\n")
        (tmp_path / name).chmod(0o755)
    given = {"SLURM_JOB_NODELIST": "both", "SLURM_NNODES": "2", "SLURM_JOB_ID": "7",
             "PATH": f"{tmp_path}:{os.environ['PATH']}"}  # fmt: skip
    run = subprocess.run(["bash", FOLDER / "slurm.sh"], env=given, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    one, other = (shlex.split(line) for line in run.stdout.splitlines())
    assert one == other and "--rdzv-endpoint first:29500" in " ".join(one)
    assert launched(one).nnodes == "2"


def launched(words: list[str]) -> Namespace:
    """What torchrun makes of its words; those behind -m are a stage of ours and its settings."""
    at = words.index("-m")
    assert find_spec(words[at + 1]) is not None
    given = [word for word in words[at:] if "=" in word and not word.startswith("--")]
    settings, network = split_network_overrides(given)
    assert load_train(None, TrainGenerationConfig, settings).stream and not network
    return parse_args([*words[:at], "module.py"])


def test_kubernetes() -> None:
    service, job = yaml.safe_load_all((FOLDER / "kubernetes.yaml").read_text())
    assert job["spec"]["completionMode"] == "Indexed"
    pod = job["spec"]["template"]["spec"]
    assert pod["subdomain"] == service["metadata"]["name"]
    host = f"{job['metadata']['name']}-0.{pod['subdomain']}"
    for index in range(job["spec"]["completions"]):  # as Kubernetes fills them in
        words = pod["containers"][0]["args"]
        run = launched([word.replace("$(JOB_COMPLETION_INDEX)", str(index)) for word in words])
        assert (int(run.nnodes), run.node_rank) == (job["spec"]["completions"], index)
        assert run.master_addr == host
    mounts = {mount["name"] for mount in pod["containers"][0]["volumeMounts"]}
    assert mounts == {volume["name"] for volume in pod["volumes"]}


def test_accelerate() -> None:
    config = load_config_from_file(str(FOLDER / "fsdp2.yaml"))
    assert config.distributed_type == "FSDP" and config.fsdp_config == {"fsdp_version": 2}
