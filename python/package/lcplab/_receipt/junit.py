"""A run for continuous integration: JUnit XML and SARIF."""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree

from lcplab._receipt.findings import STAGES
from lcplab._receipt.receipt import Receipt
from lcplab._receipt.runs import Run


def junit(run: Run) -> str:
    """The run as JUnit XML: one test case for each frame; rejected frames that the baseline lists are skipped."""
    new = [name for name in run.rejected if name not in run.known]
    reasons = [*([run.unchecked] if run.unchecked else []), *run.worse]
    counts = {"tests": len(run.receipts) + bool(reasons), "failures": len(new) + bool(reasons), "skipped": len(run.known)}
    words = {"name": "lcplab receipts", **{key: str(count) for key, count in counts.items()}}
    suite = ElementTree.Element("testsuite", words)
    for name, receipt in run.receipts.items():
        case = ElementTree.SubElement(suite, "testcase", classname="lcplab.receipts", name=name)
        properties = ElementTree.SubElement(case, "properties")
        for key, value in (("verdict", receipt.verdict), ("motion_error", receipt.motion_error)):
            ElementTree.SubElement(properties, "property", name=key, value=str(value))
        if name in run.known:
            ElementTree.SubElement(case, "skipped", message="listed in the baseline")
        elif receipt.is_rejected:
            ElementTree.SubElement(case, "failure", message=_message(receipt)).text = str(receipt)
    if reasons:
        case = ElementTree.SubElement(suite, "testcase", classname="lcplab.receipts", name="run")
        ElementTree.SubElement(case, "failure", message=reasons[0]).text = "\n".join(reasons)
    ElementTree.indent(suite)
    return ElementTree.tostring(suite, encoding="unicode", xml_declaration=True) + "\n"


def sarif(run: Run) -> dict[str, Any]:
    """The run as SARIF 2.1.0: one rule for each stage, one result for each rejected frame."""
    rules = [{"id": f"receipt/{stage}", "shortDescription": {"text": f"The stage {stage} of an engine's step"}}
             for stage in STAGES]
    results = []
    for name in run.rejected:
        receipt = run.receipts[name]
        result: dict[str, Any] = {
            "ruleId": f"receipt/{receipt.stage}",
            "level": "note" if name in run.known else "error",
            "message": {"text": str(receipt)},
            "locations": [{"physicalLocation": {"artifactLocation": {"uri": name.replace(" ", "%20")}}}],
        }
        if name in run.known:
            result["suppressions"] = [{"kind": "external", "justification": "listed in the baseline"}]
        results.append(result)
    return {
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{"tool": {"driver": {"name": "lcplab", "rules": rules}}, "results": results}],
    }


def _message(receipt: Receipt) -> str:
    what = receipt.rejected.what if receipt.rejected else receipt.verdict
    return f"{receipt.stage}: {what}"
