"""For each format the fields of its standard: a plain file, and one with the field set to something unusual. NAME.json
has both by format and field; docs/FIELDS.md says of each whether it is read or noted."""
import json
import os
import sys

import numpy as np

folder = sys.argv[1]
fields = {}
number = 0
values = np.random.default_rng(3).integers(1, 200, (4, 5, 6))


def path(end):
    global number
    number += 1
    os.makedirs(os.path.join(folder, f"f{number}"))
    return os.path.join(f"f{number}", "file" + end)


def full(name):
    return os.path.join(folder, name)


def add(kind, field, plain, changed, same=False, refused=False, **options):
    """same: the field says where the same values are. refused: for what the field says the file is not read."""
    fields.setdefault(kind, {})[field] = dict(plain=plain, changed=changed, same=same, refused=refused, options=options)


def done(name):
    with open(full(name + ".json"), "w") as out:
        json.dump(fields, out)
