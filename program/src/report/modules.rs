//! Joins the modules of a page's script into one script, because a page that is opened from disk
//! cannot import files.
//!
//! The files of `report/script` are ES modules, so that editors and `tsc` know each name. They use
//! four forms, each at the start of a line: `import { a, b } from "./x.js";`, `import "./x.js";`,
//! and `export` before `const`, `let`, `function`, `async function` or `class`. The joined modules
//! share one scope, which costs no byte and lets `tests/page` reach every name. Therefore no two
//! modules may declare the same name at their top.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// A module of the script.
struct Module<'a> {
    file: &'a str,
    /// The imported names of each file, in the order of the statements.
    imports: Vec<(String, Vec<String>)>,
    /// The names that are declared at the top, and whether each is exported.
    names: Vec<(&'a str, bool)>,
    /// The text without its imports and the word `export`.
    text: String,
}

impl<'a> Module<'a> {
    fn parse(file: &'a str, source: &'a str) -> Result<Self, String> {
        let mut module = Module {
            file,
            imports: Vec::new(),
            names: Vec::new(),
            text: String::new(),
        };
        let mut lines = source.lines();
        while let Some(line) = lines.next() {
            let unknown = || format!("{file}: unknown form: {line}");
            if line.starts_with("import") {
                let mut statement = line.to_string();
                while !statement.ends_with(';') {
                    statement += lines.next().ok_or_else(unknown)?.trim();
                }
                module.imports.push(import(&statement).ok_or_else(unknown)?);
                continue;
            }
            let exported = line.strip_prefix("export ");
            let code = exported.unwrap_or(line);
            if let Some(name) = declared(code) {
                module.names.push((name, exported.is_some()));
            } else if line.starts_with("export") {
                return Err(unknown());
            }
            module.text += code;
            module.text.push('\n');
        }
        Ok(module)
    }
}

/// Reads an import: the file, and the imported names.
fn import(statement: &str) -> Option<(String, Vec<String>)> {
    let rest = statement.strip_prefix("import ")?.strip_suffix("\";")?;
    let (list, file) = rest.split_once("\"./")?;
    let names = if list.is_empty() {
        Vec::new()
    } else {
        let list = list.strip_prefix('{')?.strip_suffix("} from ")?;
        let names = list.split(',').map(str::trim);
        names.filter(|name| !name.is_empty()).collect()
    };
    let is_plain = names.iter().all(|name| identifier(name) == *name);
    is_plain.then(|| (file.into(), names.into_iter().map(Into::into).collect()))
}

/// Returns the name that a line declares.
fn declared(line: &str) -> Option<&str> {
    let kinds = ["const ", "let ", "function ", "async function ", "class "];
    let rest = kinds.iter().find_map(|kind| line.strip_prefix(kind))?;
    Some(identifier(rest)).filter(|name| !name.is_empty())
}

/// Returns the identifier at the start of a text.
fn identifier(text: &str) -> &str {
    let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '$'));
    &text[..end.unwrap_or(text.len())]
}

/// Joins `entry` and the modules that it needs, each after those that it imports itself. `files`
/// has the name and the text of each module.
pub(super) fn joined(files: &[(&str, &str)], entry: &str) -> Result<String, String> {
    let mut all = Vec::new();
    visit(files, entry, &mut Vec::new(), &mut all)?;
    let mut script = String::from("\"use strict\";\n");
    let mut owners: Vec<(&str, &str)> = Vec::new();
    for module in &all {
        for (file, names) in &module.imports {
            let from = all.iter().find(|m| m.file == file).expect("visited");
            if let Some(name) = names.iter().find(|n| !from.names.contains(&(&***n, true))) {
                return Err(format!("{}: {file} does not export {name}", module.file));
            }
        }
        for (name, _) in &module.names {
            if let Some((_, other)) = owners.iter().find(|(known, _)| known == name) {
                return Err(format!("{name} is declared in {other} and {}", module.file));
            }
            owners.push((name, module.file));
        }
        script += &module.text;
    }
    Ok(script)
}

/// Adds a module to `all`, after those that it imports. `path` leads from the entry to it.
fn visit<'a>(
    files: &[(&'a str, &'a str)],
    file: &str,
    path: &mut Vec<&'a str>,
    all: &mut Vec<Module<'a>>,
) -> Result<(), String> {
    if all.iter().any(|module| module.file == file) {
        return Ok(());
    }
    let known = files.iter().find(|(name, _)| *name == file);
    let (file, source) = *known.ok_or_else(|| format!("no module {file}"))?;
    if path.contains(&file) {
        return Err(format!("a cycle of imports: {}, {file}", path.join(", ")));
    }
    path.push(file);
    let module = Module::parse(file, source)?;
    for (imported, _) in &module.imports {
        visit(files, imported, path, all)?;
    }
    path.pop();
    all.push(module);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Joins `a.js` with these texts of `a.js` and `b.js`.
    fn of(a: &str, b: &str) -> Result<String, String> {
        joined(&[("a.js", a), ("b.js", b)], "a.js")
    }

    #[test]
    fn modules_come_after_what_they_import() {
        let a = "import {\n\tx, y,\n} from \"./b.js\";\nimport \"./b.js\";\nconst z = x + y;\n";
        let b = "export const x = 1;\nexport function y() {}\n";
        let script = "\"use strict\";\nconst x = 1;\nfunction y() {}\nconst z = x + y;\n";
        assert_eq!(of(a, b).unwrap(), script);
        assert_eq!(
            of("const z = 1;\n", b).unwrap(),
            "\"use strict\";\nconst z = 1;\n"
        );
    }

    #[test]
    fn what_a_browser_would_refuse_is_refused() {
        let uses_x = "import { x } from \"./b.js\";\n";
        for (a, b, told) in [
            (uses_x, "const x = 1;\n", "a.js: b.js does not export x"),
            (uses_x, "", "a.js: b.js does not export x"),
            ("import \"./c.js\";\n", "", "no module c.js"),
            (
                uses_x,
                "import { z } from \"./a.js\";\nexport const x = 1;\n",
                "a cycle of imports: a.js, b.js, a.js",
            ),
            (
                "import { x } from \"./b.js\";\nconst y = 1;\n",
                "export const x = 1;\nfunction y() {}\n",
                "y is declared in b.js and a.js",
            ),
            (
                "import { x } from \"./b.js\";\nconst x = 1;\n",
                "export const x = 1;\n",
                "x is declared in b.js and a.js",
            ),
        ] {
            assert_eq!(of(a, b).unwrap_err(), told);
        }
        for form in [
            "import x from \"./b.js\";",
            "import * as x from \"./b.js\";",
            "import { x as y } from \"./b.js\";",
            "import { x } from \"b.js\";",
            "import { x } from \"./b.js\"",
            "export { x };",
            "export default 1;",
            "export const { x } = y;",
            "export * from \"./b.js\";",
        ] {
            let told = of(&format!("{form}\n"), "").unwrap_err();
            assert_eq!(told, format!("a.js: unknown form: {form}"));
        }
    }
}
