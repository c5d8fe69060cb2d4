"""What every test run shares: no network, few threads, repeatable property tests."""

import logging
import os
from collections.abc import Iterator
from pathlib import Path

# Before torch and transformers are imported anywhere.
os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ["HF_HUB_OFFLINE"] = "1"
os.environ["TOKENIZERS_PARALLELISM"] = "false"

import pytest
from hypothesis import HealthCheck, settings

# The first example of a test pays for imports: time limits would only fail on slow machines.
settings.register_profile(
    "suite", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("suite")


@pytest.fixture(scope="session")
def scheduler() -> Iterator[str]:
    """Address of a Dask cluster of two processes; it gives a job up that kills two of them."""
    distributed = pytest.importorskip("distributed")
    import dask

    with (
        dask.config.set({"distributed.scheduler.allowed-failures": 1}),
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None,
            silence_logs=logging.CRITICAL, scheduler_kwargs={"dashboard_address": ":0"},
        ) as cluster,
    ):  # fmt: skip
        yield cluster.scheduler_address


@pytest.fixture
def bucket(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """gs:// address of an empty bucket of a real emulator, which any process finds."""
    pytest.importorskip("gcp_storage_emulator")
    from tests.shared.data.phrases.gcs_proxy import BUCKET, emulator  # sets a switch of gcsfs

    gcsfs, fsspec = pytest.importorskip("gcsfs"), pytest.importorskip("fsspec")
    with emulator(tmp_path / "emulator.log") as address:
        for name, value in {"endpoint_url": address, "token": "anon"}.items():
            monkeypatch.setenv(f"FSSPEC_GS_{name.upper()}", value)
            monkeypatch.setitem(fsspec.config.conf.setdefault("gs", {}), name, value)
        yield f"gs://{BUCKET}"
        gcsfs.GCSFileSystem.clear_instance_cache()
