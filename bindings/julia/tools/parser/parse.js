// SPDX-License-Identifier: BSD-3-Clause
//
// node parse.js FOLDER < {"name": "text of a Julia file", ...}: the syntax tree of each as JSON on standard output.
//
// FOLDER has tree-sitter.js, tree-sitter.wasm and tree-sitter-julia.wasm. A node is [type, line, column, children], a
// leaf has its text in place of children; lines and columns count from 1. Type ERROR is what could not be parsed, and
// MISSING what would have to stand there.
"use strict";
const fs = require("fs");
const path = require("path");

// The optimising compiler takes six seconds for the grammar, which then runs for one.
require("v8").setFlagsFromString("--liftoff-only");

const folder = path.resolve(process.argv[2]);
const Parser = require(path.join(folder, "tree-sitter.js"));

function tree(cursor, text) {
    const { row, column } = cursor.startPosition;
    const node = [cursor.nodeIsMissing ? "MISSING" : cursor.nodeType, row + 1, column + 1, ""];
    if (cursor.gotoFirstChild()) {
        node[3] = [];
        do {
            node[3].push(tree(cursor, text));
        } while (cursor.gotoNextSibling());
        cursor.gotoParent();
    } else {
        node[3] = text.slice(cursor.startIndex, cursor.endIndex);
    }
    return node;
}

async function main() {
    await Parser.init({ locateFile: (name) => path.join(folder, name) });
    const parser = new Parser();
    parser.setLanguage(await Parser.Language.load(path.join(folder, "tree-sitter-julia.wasm")));
    const files = JSON.parse(fs.readFileSync(0, "utf8"));
    const trees = {};
    for (const name of Object.keys(files)) {
        trees[name] = tree(parser.parse(files[name]).walk(), files[name]);
    }
    process.stdout.write(JSON.stringify(trees));
}

main().catch((error) => {
    process.stderr.write(`parse.js: ${error.stack}\n`);
    process.exitCode = 1;
});
