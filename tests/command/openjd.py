#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks a job template by the specification jobtemplate-2023-09 and runs its tasks, a step after those that it depends on.

  openjd.py TEMPLATE NAME=VALUE...    runs every task; what they print goes through. Ends with 1 at a task that fails, 2 at a template that is wrong"""
import itertools
import re
import subprocess
import sys
import tempfile

import yaml

# Members by the specification, of which those with "!" must be there; of what the templates here use.
MEMBERS = {
    "template": "specificationVersion! name! description parameterDefinitions steps!",
    "STRING": "name! type! description default allowedValues minLength maxLength",
    "PATH": "name! type! description default allowedValues minLength maxLength objectType dataFlow",
    "INT": "name! type! description default allowedValues minValue maxValue",
    "step": "name! description dependencies parameterSpace script!",
    "dependency": "dependsOn!",
    "space": "taskParameterDefinitions! combination",
    "task parameter": "name! type! range!",
    "script": "actions! embeddedFiles",
    "actions": "onRun!",
    "action": "command! args timeout cancelation",
    "cancelation": "mode! notifyPeriodInSeconds",
    "file": "name! type! filename data! runnable",
}


def wrong(text):
    print("openjd.py:", text, file=sys.stderr)
    sys.exit(2)


def members(value, kind):
    known = MEMBERS[kind].split()
    for name in value:
        if name not in [k.rstrip("!") for k in known]:
            wrong(f"{kind} {value.get('name', '')}: unknown member {name}")
    for name in known:
        if name.endswith("!") and name[:-1] not in value:
            wrong(f"{kind} {value.get('name', '')}: {name[:-1]} is missing")
    if "name" in value and not 1 <= len(value["name"]) <= 64:
        wrong(f"{kind}: a name of {len(value['name'])} characters")
    if len(value.get("description", "")) > 2048:
        wrong(f"{kind} {value['name']}: the description is too long")


def identifiers(values, what):
    names = [v["name"] for v in values]
    for name in names:
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name) or names.count(name) > 1:
            wrong(f"{what}: the name {name}")


def resolved(text, values):
    def value(match):
        if match[1].strip() not in values:
            wrong(f"nothing is named {match[1]}")
        return str(values[match[1].strip()])

    return re.sub(r"\{\{(.*?)\}\}", value, text)


def integers(expression):
    """The values of a range expression."""
    found = []
    for element in expression.split(","):
        match = re.fullmatch(r"\s*(-?\d+)\s*(?:-\s*(-?\d+)\s*(?::\s*(-?[1-9]\d*))?)?\s*", element)
        if not match:
            wrong(f"range: {expression}")
        first, last, step = int(match[1]), int(match[2] or match[1]), int(match[3] or 1)
        found += range(first, last + (1 if step > 0 else -1), step)
    if not 1 <= len(set(found)) == len(found) <= 1024:
        wrong(f"range: {expression} has {len(found)} values")
    return sorted(found)


def job_values(template, given):
    definitions = template.get("parameterDefinitions", [])
    identifiers(definitions, "parameters")
    values = {}
    for d in definitions:
        members(d, d["type"])
        if d.get("objectType", "FILE") not in ("FILE", "DIRECTORY") or d.get("dataFlow", "NONE") not in ("NONE", "IN", "OUT", "INOUT"):
            wrong(f"parameter {d['name']}: objectType or dataFlow")
        value = given.pop(d["name"], d.get("default"))
        if value is None:
            wrong(f"parameter {d['name']}: no value and no default")
        if d["type"] == "INT" and not d.get("minValue", int(value)) <= int(value) <= d.get("maxValue", int(value)):
            wrong(f"parameter {d['name']}: {value} is out of range")
        if d["type"] != "INT" and not (isinstance(value, str) and len(value) <= 1024):
            wrong(f"parameter {d['name']}: {value!r} is no text")
        values[f"Param.{d['name']}"] = values[f"RawParam.{d['name']}"] = value
    if given:
        wrong(f"no parameters: {', '.join(given)}")
    return values


def check_step(step):
    members(step, "step")
    for d in step.get("dependencies", []):
        members(d, "dependency")
    members(step["script"], "script")
    members(step["script"]["actions"], "actions")
    action = step["script"]["actions"]["onRun"]
    members(action, "action")
    if "cancelation" in action:
        members(action["cancelation"], "cancelation")
        if action["cancelation"]["mode"] not in ("TERMINATE", "NOTIFY_THEN_TERMINATE"):
            wrong(f"step {step['name']}: cancelation")
    files = step["script"].get("embeddedFiles", [])
    identifiers(files, step["name"])
    for f in files:
        members(f, "file")
        if f["type"] != "TEXT":
            wrong(f"file {f['name']}: its type is {f['type']}")


def run_step(step, values, folder):
    space = step.get("parameterSpace", {"taskParameterDefinitions": []})
    members(space, "space")
    parameters = space["taskParameterDefinitions"]
    identifiers(parameters, step["name"])
    for p in parameters:
        members(p, "task parameter")
        if p["type"] != "INT":
            wrong(f"task parameter {p['name']}: only INT is known here")
    for combination in itertools.product(*(integers(resolved(p["range"], values)) for p in parameters)):
        scope = dict(values)
        for p, value in zip(parameters, combination):
            scope[f"Task.Param.{p['name']}"] = value
        files = step["script"].get("embeddedFiles", [])
        scope.update({f"Task.File.{f['name']}": f"{folder}/{f['name']}" for f in files})
        for f in files:
            with open(scope[f"Task.File.{f['name']}"], "w") as out:
                out.write(resolved(f["data"], scope))
        action = step["script"]["actions"]["onRun"]
        if subprocess.run([resolved(word, scope) for word in [action["command"], *action.get("args", [])]]).returncode:
            print(f"openjd.py: {step['name']} {combination}: the task failed", file=sys.stderr)
            sys.exit(1)


def main():
    with open(sys.argv[1]) as file:
        template = yaml.safe_load(file)
    members(template, "template")
    if template["specificationVersion"] != "jobtemplate-2023-09":
        wrong(template["specificationVersion"])
    values = job_values(template, dict(word.split("=", 1) for word in sys.argv[2:]))
    left = template["steps"]
    for step in left:
        check_step(step)
    done = set()
    with tempfile.TemporaryDirectory() as folder:
        while left:
            ready = [s for s in left if all(d["dependsOn"] in done for d in s.get("dependencies", []))]
            if not ready:
                wrong(f"steps wait for each other or for one that is not there: {', '.join(s['name'] for s in left)}")
            for step in ready:
                run_step(step, values, folder)
                done.add(step["name"])
            left = [s for s in left if s["name"] not in done]


main()
