"""Checks JSON and TOML files against a schema that lcplab prints: schema.py SCHEMA FILE..."""

import json
import sys
import tomllib

from jsonschema import Draft202012Validator

schema = json.load(open(sys.argv[1]))
Draft202012Validator.check_schema(schema)
validator = Draft202012Validator(schema)


def read(name):
    with open(name, "rb") as file:
        return (tomllib if name.endswith(".toml") else json).load(file)


wrong = 0
for name in sys.argv[2:]:
    for error in validator.iter_errors(read(name)):
        print(f"{name}: {error.json_path}: {error.message[:200]}")
        wrong += 1
print(f"{len(sys.argv) - 2} files, {wrong} errors")
sys.exit(1 if wrong else 0)
