"""What stands in the pages of the documentation: commands, the lines that they print, job files."""
import re
import textwrap

# Beginnings of commands that do not run here, with what does run them.
ELSEWHERE = {
    "./touchstone test": "touchstone_script_test.sh",
    "cmake --preset": ".ci/run and candidates/example/example_test.sh",
    "cpack ": "cmake/package_test.sh",
    "touchstone --version": "cli/tests/usage_test.sh",
    "cmake -S reference": "ReferenceAlone.BuildsAndInstalls",
    "parallel ": "reports/campaigns/campaign_test.sh, one shard after the other",
    "python3 oracle/check_certificate_test.py": "check_certificate",
    "python3 oracle/forge_certificates.py": "forge_certificates",
    "apt-get ": "nothing: it needs the network",
    "./touchstone report --seed 1 --count 20 --group everyday": "engine_table_test.py, a long test",
    "./touchstone report --history": "candidates/npm/history_test.sh, a long test",
    "./touchstone compare rapier@": "candidates/npm/history_test.sh, a long test",
    "cd out/render": "simulation/scenes/povray_test.cpp, which writes what POV-Ray reads",
}


def elsewhere_of(command):
    """The beginning that says that a command runs elsewhere, or None."""
    return next((start for start in ELSEWHERE if command.startswith(start)), None)


def commands_of(block):
    """One string for each command, without comments and with its lines joined."""
    lines = re.sub(r"\\\n\s*", "", block).splitlines()
    return [c for c in (re.sub(r"(^|\s+)#.*", "", line).strip() for line in lines) if c]


RUN = re.compile(r"^( *)run: \|\n((?:\1 +.*\n)+)", re.MULTILINE)  # a step of a workflow
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
JOBS = 3  # of a job file that says how many by itself


def is_job_file(text):
    return "#SBATCH" in text or "kind: Job" in text


def job_files_of(page):
    """The texts of job files, from a page's text."""
    return [text for _, text in FENCE.findall(page) if is_job_file(text)]


def job_of(text):
    """A job file's script, and the environment of each of its jobs."""
    if "#SBATCH" in text:
        return text, [{"SLURM_ARRAY_TASK_ID": str(i + 1), "SLURM_ARRAY_TASK_COUNT": str(JOBS),
                       "SLURM_CPUS_PER_TASK": "1"} for i in range(JOBS)]
    script = re.search(r"^( *)- \|\n((?:\1 .*\n|\n)+)", text, re.MULTILINE)
    named = dict(re.findall(r'name: (\w+), value: "(\d+)"', text))
    completions = re.search(r"^ *completions: (\d+)$", text, re.MULTILINE)
    if not script or "completionMode: Indexed" not in text or not completions:
        raise ValueError("is no indexed job with a script")
    if named != {"SHARDS": completions[1]}:
        raise ValueError("has another number of completions than of shards")
    return textwrap.dedent(script[2]), [{"JOB_COMPLETION_INDEX": str(i), "SHARDS": str(JOBS)}
                                        for i in range(JOBS)]


def blocks_of(page):
    """Pairs of commands and the lines that they print, from a page's text."""
    blocks = []
    for mark, text in FENCE.findall(page):
        if is_job_file(text):
            continue
        if mark == "sh":
            blocks.append((commands_of(text), []))
        elif mark == "yaml":
            blocks.append((commands_of("".join(script for _, script in RUN.findall(text))), []))
        elif mark == "":
            blocks[-1][1].extend(text.splitlines())
    within_sentences = re.findall(r"`(\./touchstone [^`]*)`", FENCE.sub("", page))
    return blocks + [([c], []) for c in dict.fromkeys(within_sentences)]
