//! `fastphong diff FOLDER FOLDER`: compares all pictures of a folder with the references of the
//! same names in another.

use super::super::output::{self, Output, print_beside};
use super::super::progress::Progress;
use super::super::text::{counted, part_of};
use super::super::tolerance::Tolerance;
use super::super::{CliError, Log, Outcome, contents::Contents, files, input_name::printable};
use super::compared::{Compared, Status, compare, count, summary};
use super::pairing::Pairing;
use super::{DiffArgs, add, junit, page};
use crate::compare::table::aligned;
use serde_json::{Value, json};
use std::time::Instant;

/// Compares two folders as the flags say.
pub fn run(args: &DiffArgs, log: Log) -> Result<Outcome, CliError> {
    args.check_for_folders()?;
    let outputs = Outputs::of(args);
    let outputs_list: Vec<&Output> = outputs.list();
    let pairing = Pairing::of(&args.reference, &args.actual)?;
    for pair in &pairing.pairs {
        if let Some(path) = &pair.reference {
            files::will_read(path, "a reference");
        }
        if let Some(path) = &pair.actual {
            files::will_read(path, "a picture");
        }
    }
    let threshold = Some(args.fail_above.unwrap_or(0.0));
    let tolerance = args.tolerance.with(threshold, "--fail-above")?;
    output::check(&outputs_list)?;
    if pairing.others > 0 {
        let others = counted(pairing.others, "file is left out", "files are left out");
        log.note(&format!(
            "{others}: expected plain files with the ending of a picture format"
        ));
    }
    let mut page = outputs.page.as_ref().map(|_| page::Page::default());
    let compared = compare_all(args, pairing, &tolerance, page.as_mut(), log);
    if let (Some(output), Some(page)) = (&outputs.page, page) {
        output.make_folder()?;
        output.write_text(&page.html(args, &compared, &tolerance))?;
    }
    if let Some(output) = &outputs.junit {
        output.make_folder()?;
        output.write_text(&junit::xml(args, &compared))?;
    }
    let approved = if args.approve {
        approve(&compared)?
    } else {
        Vec::new()
    };
    let text = if args.json {
        format!("{:#}\n", json(args, &compared, &tolerance, &approved))
    } else {
        text(&compared, &approved, log)
    };
    print_beside(&outputs_list, &text)?;
    let failed = compared.iter().filter(|one| one.status.fails()).count();
    if !args.json
        && failed > approved.len()
        && approved.is_empty()
        && compared.iter().any(Compared::is_approved)
    {
        log.note("`--approve` copies pictures that differ or are new over the references");
    }
    Ok(if failed > approved.len() {
        Outcome::Differs
    } else {
        Outcome::Done
    })
}

/// The files that are written.
struct Outputs {
    page: Option<Output>,
    junit: Option<Output>,
}

impl Outputs {
    fn of(args: &DiffArgs) -> Outputs {
        let output = |name, path: &Option<_>, contents| {
            let path: Option<&std::path::PathBuf> = path.as_ref();
            path.map(|path| Output::new(name, path, contents))
        };
        Outputs {
            page: output("--html", &args.html, Contents::Page),
            junit: output("--junit", &args.junit, Contents::Xml),
        }
    }

    fn list(&self) -> Vec<&Output> {
        self.page.iter().chain(&self.junit).collect()
    }
}

/// Compares all pairs, one after the other, and adds their pictures to `page`.
fn compare_all(
    args: &DiffArgs,
    pairing: Pairing,
    tolerance: &Tolerance<'_>,
    mut page: Option<&mut page::Page>,
    log: Log,
) -> Vec<Compared> {
    let progress = Progress::watched(log);
    let all = pairing.pairs.len();
    let mut compared = Vec::new();
    for (i, pair) in pairing.pairs.into_iter().enumerate() {
        progress.at(i as f32 / all as f32, &pair.name);
        let started = Instant::now();
        let (mut one, pictures) = compare(args, pair, tolerance);
        if let Some(page) = page.as_deref_mut()
            && let Err(error) = page.add(args, &one, &pictures, tolerance)
        {
            one.notes.push(format!("not on the page: {error}"));
        }
        one.time = started.elapsed();
        progress.aside(|| {
            for note in &one.notes {
                log.warning(&format!("{}: {note}", one.pair.name));
            }
        });
        compared.push(one);
    }
    compared
}

/// Copies the pictures that differ or are new over their references, all or none, and returns their
/// names.
fn approve(compared: &[Compared]) -> Result<Vec<String>, CliError> {
    let approved: Vec<&Compared> = compared.iter().filter(|one| one.is_approved()).collect();
    let copies = approved.iter().filter_map(|one| {
        let from = one.pair.actual.as_deref()?;
        Some(files::Copy {
            from,
            to: &one.pair.place,
        })
    });
    files::copy_all(&copies.collect::<Vec<_>>())?;
    Ok(approved.iter().map(|one| one.pair.name.clone()).collect())
}

/// Returns a row for each pair, the summary, and the approved pictures. Equal pairs are left out,
/// unless `log` is verbose.
fn text(compared: &[Compared], approved: &[String], log: Log) -> String {
    let mut shown: Vec<&Compared> = compared.iter().collect();
    shown.retain(|one| one.status != Status::Equal || log == Log::Verbose);
    shown.sort_by_key(|one| one.status);
    let rows = shown.iter().map(|one| {
        let region = one.judged.as_ref().map(|judged| judged.region_text());
        let region = region.unwrap_or_default();
        let region = match region.trim_end() {
            "" => String::new(),
            region => format!("; {region}"),
        };
        let text = printable(&one.text);
        [
            one.status.name().to_owned(),
            one.pair.name.clone(),
            text + &region,
        ]
    });
    let mut text = aligned(&rows.collect::<Vec<_>>(), &[0, 1, 2]);
    text += &format!("{}\n", summary(compared));
    if !approved.is_empty() {
        let of = part_of(approved.len(), compared.len(), "picture");
        text += &format!("approved {of}:\n");
        text.extend(approved.iter().map(|name| format!("  {name}\n")));
    }
    text
}

/// Returns the result as JSON.
fn json(
    args: &DiffArgs,
    compared: &[Compared],
    tolerance: &Tolerance<'_>,
    approved: &[String],
) -> Value {
    let pair = |one: &Compared| {
        let mut object = json!({
            "name": one.pair.name,
            "status": one.status.name(),
            "failed": one.status.fails(),
            "text": one.text,
            "notes": one.notes,
            "seconds": one.time.as_secs_f64(),
            "approved": approved.contains(&one.pair.name),
        });
        add(&mut object, one.fields.clone());
        object
    };
    let counts =
        Status::ALL.map(|status| (status.name().to_owned(), count(compared, status).into()));
    let counts: serde_json::Map<String, Value> = counts.into_iter().collect();
    let failed = compared.iter().filter(|one| one.status.fails()).count();
    let mut object = json!({
        "schema": "fastphong.diff-folders/1",
        "reference": args.reference.display().to_string(),
        "actual": args.actual.display().to_string(),
    });
    add(&mut object, tolerance.json());
    object["counts"] = counts.into();
    object["approved"] = json!(approved);
    object["failed"] = (failed > approved.len()).into();
    object["pairs"] = compared.iter().map(pair).collect();
    object
}
