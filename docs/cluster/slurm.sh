#!/bin/bash
# Two machines of eight GPUs: sbatch docs/cluster/slurm.sh, from a checkout that all of them see.
#SBATCH --job-name=motion-train
#SBATCH --nodes=2
#SBATCH --ntasks-per-node=1
#SBATCH --gpus-per-node=8
#SBATCH --cpus-per-task=64
#SBATCH --time=24:00:00
#SBATCH --signal=TERM@120
#SBATCH --requeue
set -euo pipefail
DATA=${DATA:-/shared/prepared}
OUTPUT=${OUTPUT:-/shared/runs/mine}
PROCESSES=${PROCESSES:-8} # a machine
SETTINGS=${SETTINGS:-clip=/shared/runs/clip stream=true num-workers=2}

HOSTS=$(scontrol show hostnames "$SLURM_JOB_NODELIST")
MASTER=${HOSTS%%$'\n'*} # the first line; a pipe that ends early would end this script, too
# --resume: a job that was stopped (TERM saves) or requeued goes on; a new one starts.
# shellcheck disable=SC2086
srun torchrun \
  --nnodes "$SLURM_NNODES" --nproc-per-node "$PROCESSES" \
  --rdzv-id "$SLURM_JOB_ID" --rdzv-backend c10d --rdzv-endpoint "$MASTER:29500" \
  -m "${STAGE:-src.train.train_generation}" \
  --data "$DATA" --output "$OUTPUT" --resume $SETTINGS
