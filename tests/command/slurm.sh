# shellcheck shell=bash disable=SC2154
# The part of farm.sh that starts a cluster of one machine: munged, slurmctld and slurmd, for this test alone.

chmod 755 .
mkdir -p slurm/spool slurm/state slurm/munge
dd if=/dev/urandom of=slurm/munge/key bs=64 count=1 2>/dev/null
chmod 700 slurm/munge && chmod 400 slurm/munge/key
munged --force --foreground --key-file="$PWD/slurm/munge/key" --socket="$PWD/slurm/munge.socket" \
    --pid-file="$PWD/slurm/munge/pid" --seed-file="$PWD/slurm/munge/seed" --log-file="$PWD/slurm/munge/log" >/dev/null 2>&1 &
daemons=($!)
cat >slurm/slurm.conf <<CONF
ClusterName=test
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$PWD/slurm/munge.socket
CryptoType=crypto/munge
SlurmctldPort=27817
SlurmdPort=27818
StateSaveLocation=$PWD/slurm/state
SlurmdSpoolDir=$PWD/slurm/spool
SlurmctldPidFile=$PWD/slurm/ctld.pid
SlurmdPidFile=$PWD/slurm/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1,requeue_delay=1
MpiDefault=none
ReturnToService=2
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$PWD/slurm/slurm.conf STRAHL=$PWD/mortal
sleep 1
slurmctld -D >slurm/ctld.log 2>&1 &
daemons+=($!)
sleep 1
slurmd -D -N "$(hostname -s)" >slurm/slurmd.log 2>&1 &
daemons+=($!)

# by_slurm TASKS ARGUMENT...: submits the script and waits until all tasks are completed. One that is being requeued is
# not in the queue for a moment, but it is still known.
by_slurm() {
    local waited job
    job=$(sbatch --parsable -o slurm/%a.out --array="1-$1" "$source_folder/assets/farm/strahl.slurm" scene.rt "${@:2}" 2>said) ||
        fault "sbatch: $(<said)"
    for ((waited = 0; waited < 600; ++waited)); do
        scontrol -o show job "$job" >said 2>&1
        [[ $(grep -c JobState=COMPLETED said) == "$1" ]] && return
        # Begun anew too soon after it was killed ("credential revoked"), a task counts as failed.
        scontrol requeue "$(grep JobState=FAILED said | grep -o '^JobId=[0-9]*' | cut -d= -f2 | paste -sd,)" >/dev/null 2>&1
        # Some tasks are begun anew as if their machine had failed; Slurm would hold them back for two minutes.
        ((waited >= 20)) || scontrol requeue "$(squeue -h -t R -o %A | shuf -n 1)" >/dev/null 2>&1
        scontrol update JobId="$(squeue -h -t PD -o %A | paste -sd,)" StartTime=now >/dev/null 2>&1
        sleep .5
    done
    fault "Slurm: after $((waited / 2)) s: $(grep -v JobState=COMPLETED said |
        grep -oE '(ArrayTaskId|JobState|ExitCode|Restarts)=[^ ]*' | paste -sd' ')"
}
by_slurm 8 "${film[@]}"
finished_film Slurm
by_slurm 64 "${still[@]}"
finished_still Slurm
((faults == 0)) || grep -H . slurm/*.out | tail -n 20
echo "Slurm: done"
kill "${daemons[@]}"
wait "${daemons[@]}" 2>/dev/null
