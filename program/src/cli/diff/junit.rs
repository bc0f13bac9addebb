//! A comparison of folders as JUnit XML, which CI servers show, with a test case for each pair.

use super::DiffArgs;
use super::compared::{Compared, Status, count};

/// Returns the comparison as XML. A pair that cannot be compared becomes an `error`, any other that
/// fails a `failure`.
pub fn xml(args: &DiffArgs, compared: &[Compared]) -> String {
    let errors = count(compared, Status::Unreadable);
    let failures = compared.iter().filter(|one| one.fails()).count() - errors;
    let seconds: f64 = compared.iter().map(|one| one.time.as_secs_f64()).sum();
    let attributes = format!(
        "tests=\"{}\" failures=\"{failures}\" errors=\"{errors}\" skipped=\"0\" time=\"{seconds:.3}\"",
        compared.len()
    );
    let name = format!("{} and {}", args.reference.display(), args.actual.display());
    let name = escaped(&name);
    let cases: String = compared.iter().map(case).collect();
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"fastphong diff\" {attributes}>\n\
         <testsuite name=\"{name}\" {attributes}>\n{cases}</testsuite>\n</testsuites>\n"
    )
}

/// Returns the test case of a pair.
fn case(one: &Compared) -> String {
    let (folder, file) = one
        .pair
        .name
        .rsplit_once('/')
        .unwrap_or(("", &one.pair.name));
    let class = match folder {
        "" => "pictures".to_owned(),
        // Servers read a dot as the end of a package. One in a folder's name is written otherwise,
        // so that `a.b/n.png` and `a/b/n.png` stay two cases.
        folder => format!(
            "pictures.{}",
            folder.replace('.', "\\x2E").replace('/', ".")
        ),
    };
    let seconds = one.time.as_secs_f64();
    let head = format!(
        "<testcase classname=\"{}\" name=\"{}\" time=\"{seconds:.3}\"",
        escaped(&class),
        escaped(file)
    );
    if !one.fails() {
        return format!("{head}/>\n");
    }
    let kind = one.status.name();
    let element = match one.status {
        Status::Unreadable => "error",
        _ => "failure",
    };
    let region = one
        .judged
        .as_ref()
        .map_or(String::new(), |judged| judged.region_text());
    let (message, text) = (
        escaped(&one.text),
        escaped(&format!("{}\n{region}", one.text)),
    );
    format!(
        "{head}><{element} type=\"{kind}\" message=\"{message}\">{text}</{element}></testcase>\n"
    )
}

/// Escapes text for XML 1.0, also inside attributes. Characters that XML cannot hold become U+FFFD.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for letter in text.chars() {
        match letter {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&apos;",
            // In an attribute, a parser would turn these into spaces.
            '\t' | '\n' | '\r' => out += &format!("&#{};", letter as u32),
            '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            letter => out.push(letter),
        }
    }
    out
}
