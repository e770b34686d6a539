// Every equation of the built site is one that KaTeX renders. usage: check_equations.js SITE KATEX_DIRECTORY
const fs = require("fs");
const path = require("path");

const [site, directory] = process.argv.slice(2);
const katex = require(path.join(directory, "katex.min.js"));
const entities = {"&lt;": "<", "&gt;": ">", "&quot;": '"', "&#39;": "'", "&amp;": "&"};

function* pages(folder) {
  for (const entry of fs.readdirSync(folder, {withFileTypes: true})) {
    const file = path.join(folder, entry.name);
    if (entry.isDirectory()) yield* pages(file);
    else if (entry.name.endsWith(".html")) yield file;
  }
}

let count = 0;
let broken = 0;
for (const page of pages(site)) {
  const text = fs.readFileSync(page, "utf8");
  for (const [, , equation] of text.matchAll(/<(span|div) class="arithmatex">([^]*?)<\/\1>/g)) {
    const displayMode = equation.startsWith("\\[");
    const source = equation.slice(2, -2).replace(/&(lt|gt|quot|#39|amp);/g, (entity) => entities[entity]);
    ++count;
    try {
      katex.renderToString(source, {displayMode, throwOnError: true, strict: "error"});
    } catch (error) {
      ++broken;
      console.log(`${path.relative(site, page)}: ${error.message}`);
    }
  }
}
console.log(`check_equations: ${count} equations, ${broken} broken`);
process.exit(broken > 0 || count === 0 ? 1 : 0);
