"""A folder of scans to a table of joints: a row a body.

python joint_table.py scans/ joints.csv
"""

import csv
import sys

import skelgen


def main(folder: str, table: str) -> None:
    """Write the table."""
    rows = [result.row() for result in skelgen.batch(folder)]
    columns = list(dict.fromkeys(key for row in rows for key in row))
    with open(table, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        writer.writerows(rows)
    print(f"{table}: {sum(row['status'] == 'ok' for row in rows)} of {len(rows)} bodies")


if __name__ == "__main__":
    main(*sys.argv[1:])
