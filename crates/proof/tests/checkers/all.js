// What lcpcheck.js says of pairs of a problem and a proof: JSON lines of two texts in, a word each out.
"use strict";

const fs = require("fs"), path = require("path");

const [checker, pairs] = process.argv.slice(2);
const lcpcheck = require(path.resolve(checker));

function verdict(problem, proof) {
  try {
    return lcpcheck(problem, proof).holds ? "proved" : "rejected";
  } catch {
    return "unreadable";
  }
}

const lines = fs.readFileSync(pairs, "utf8").split("\n").slice(0, -1);
console.log(lines.map((line) => verdict(...JSON.parse(line))).join("\n"));
