//! `fastphong diff FOLDER FOLDER`: compares all pictures of a folder with the references of the
//! same names in another.

use super::super::output::{self, Output, print_beside};
use super::super::progress::Progress;
use super::super::text::{counted, part_of};
use super::super::tolerance::Tolerance;
use super::super::{
    CliError, Log, Outcome, contents::Contents, files, files::Approval, input_name::printable,
};
use super::compared::{Compared, Status, compare, count, summary};
use super::pairing::Pairing;
use super::{DiffArgs, add, junit, page};
use crate::compare::table::aligned;
use serde_json::{Value, json};
use std::mem;
use std::time::Instant;

/// Compares two folders as the flags say.
pub fn run(args: &DiffArgs, log: Log) -> Result<Outcome, CliError> {
    args.check_for_folders()?;
    let outputs = Outputs::of(args);
    let outputs_list: Vec<&Output> = outputs.list();
    let pairing = Pairing::of(&args.reference, &args.actual)?;
    for pair in &pairing.pairs {
        // Also a reference that is new, so that nothing else becomes its file.
        files::will_read(&pair.place, "a reference");
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
    let mut approval = args.approve.then(|| Ok(Approval::default()));
    let mut compared = compare_all(
        args,
        pairing,
        &tolerance,
        page.as_mut(),
        approval.as_mut(),
        log,
    );
    let approved = approval.map(|approval| approval?.finish(&args.reference));
    if let Some(Ok(())) = approved {
        for one in &mut compared {
            one.is_approved = one.can_be_approved();
        }
    }
    // The page and the XML say what has become of the references.
    let written = outputs.write(args, page, &compared, &tolerance);
    approved.transpose()?;
    let text = if args.json {
        format!("{:#}\n", json(args, &compared, &tolerance))
    } else {
        text(&compared, log)
    };
    print_beside(&outputs_list, &text)?;
    written?;
    if !args.json {
        note(args, &compared, log);
    }
    Ok(if compared.iter().any(Compared::fails) {
        Outcome::Differs
    } else {
        Outcome::Done
    })
}

/// Notes what to do about pairs that fail.
fn note(args: &DiffArgs, compared: &[Compared], log: Log) {
    let mut failed = compared.iter().filter(|one| one.fails());
    if args.approve {
        let is_left = |one: &Compared| [Status::Unreadable, Status::Encoding].contains(&one.status);
        if failed.any(is_left) {
            log.note(
                "`--approve` copies pictures that differ or are new, not those that are unreadable or in another encoding",
            );
        }
    } else if failed.any(Compared::can_be_approved) {
        log.note("`--approve` copies pictures that differ or are new over the references");
    }
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

    /// Writes the page and the XML.
    fn write(
        &self,
        args: &DiffArgs,
        page: Option<page::Page>,
        compared: &[Compared],
        tolerance: &Tolerance<'_>,
    ) -> Result<(), CliError> {
        if let (Some(output), Some(page)) = (&self.page, page) {
            output.make_folder()?;
            output.write_text(&page.html(args, compared, tolerance))?;
        }
        if let Some(output) = &self.junit {
            output.make_folder()?;
            output.write_text(&junit::xml(args, compared))?;
        }
        Ok(())
    }

    fn list(&self) -> Vec<&Output> {
        self.page.iter().chain(&self.junit).collect()
    }
}

/// Compares all pairs, one after the other. Adds their pictures to `page`, and to `approval` those
/// that can be approved, until one cannot be written.
fn compare_all(
    args: &DiffArgs,
    pairing: Pairing,
    tolerance: &Tolerance<'_>,
    mut page: Option<&mut page::Page>,
    mut approval: Option<&mut Result<Approval, CliError>>,
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
        let file = mem::take(&mut one.file);
        if let Some(approval) = approval.as_deref_mut()
            && let Ok(drafts) = approval
            && one.can_be_approved()
            && let Err(error) = drafts.add(&one.pair.place, &file)
        {
            *approval = Err(error);
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

/// Returns a row for each pair, the summary, and the approved pictures. Equal pairs are left out,
/// unless `log` is verbose.
fn text(compared: &[Compared], log: Log) -> String {
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
    let approved = approved(compared);
    if !approved.is_empty() {
        let of = part_of(approved.len(), compared.len(), "picture");
        text += &format!("approved {of}:\n");
        text.extend(approved.iter().map(|name| format!("  {name}\n")));
    }
    text
}

/// Returns the names of the pictures that were approved.
fn approved(compared: &[Compared]) -> Vec<&str> {
    let approved = compared.iter().filter(|one| one.is_approved);
    approved.map(|one| &*one.pair.name).collect()
}

/// Returns the result as JSON.
fn json(args: &DiffArgs, compared: &[Compared], tolerance: &Tolerance<'_>) -> Value {
    let pair = |one: &Compared| {
        let mut object = json!({
            "name": one.pair.name,
            "status": one.status.name(),
            "failed": one.fails(),
            "text": one.text,
            "notes": one.notes,
            "seconds": one.time.as_secs_f64(),
            "approved": one.is_approved,
        });
        add(&mut object, one.fields.clone());
        object
    };
    let counts =
        Status::ALL.map(|status| (status.name().to_owned(), count(compared, status).into()));
    let counts: serde_json::Map<String, Value> = counts.into_iter().collect();
    let mut object = json!({
        "schema": "fastphong.diff-folders/1",
        "reference": args.reference.display().to_string(),
        "actual": args.actual.display().to_string(),
    });
    add(&mut object, tolerance.json());
    object["counts"] = counts.into();
    object["approved"] = json!(approved(compared));
    object["failed"] = compared.iter().any(Compared::fails).into();
    object["pairs"] = compared.iter().map(pair).collect();
    object
}
