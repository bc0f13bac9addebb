//! The comparison of one pair of pictures from two folders.

use super::super::text::{counted, grouped};
use super::super::tolerance::{Judged, Levels, Tolerance};
use super::super::{CliError, files, memory};
use super::DiffArgs;
use super::comparison::{Comparison, Perceived};
use super::pairing::Named;
use fastphong::picture::image_file::{FilePicture, Pair};
use serde_json::{Value, json};
use std::path::PathBuf;
use std::time::Duration;

/// The outcome for a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// A picture cannot be read, or the pair cannot be compared.
    Unreadable,
    /// The pictures differ by more than is allowed, or in size.
    Differs,
    /// There is a reference, but no picture.
    Missing,
    /// There is a picture, but no reference.
    New,
    /// The pictures differ, but by no more than is allowed.
    Within,
    /// The pictures are equal.
    Equal,
}

impl Status {
    /// All statuses, failures first.
    pub const ALL: [Status; 6] = [
        Status::Unreadable,
        Status::Differs,
        Status::Missing,
        Status::New,
        Status::Within,
        Status::Equal,
    ];

    /// True if a pair with this status makes the comparison of the folders fail.
    pub fn fails(self) -> bool {
        self < Status::Within
    }

    pub fn name(self) -> &'static str {
        match self {
            Status::Unreadable => "unreadable",
            Status::Differs => "differs",
            Status::Missing => "missing",
            Status::New => "new",
            Status::Within => "within",
            Status::Equal => "equal",
        }
    }
}

/// A pair and the result of its comparison.
pub struct Compared {
    pub pair: Named,
    pub status: Status,
    /// The error, or the result, in one line.
    pub text: String,
    /// The judgement of pictures of one size.
    pub judged: Option<Judged>,
    /// The fields of the comparison.
    pub fields: Value,
    /// Warnings about the pair, and facts about its files.
    pub notes: Vec<String>,
    pub time: Duration,
    /// True if the picture was read, so that it can be approved.
    is_readable: bool,
}

impl Compared {
    /// True if `--approve` copies the picture over its reference.
    pub fn is_approved(&self) -> bool {
        let is_accepted = match self.status {
            Status::Differs | Status::New => true,
            Status::Unreadable => self.is_readable,
            Status::Missing | Status::Within | Status::Equal => false,
        };
        is_accepted && self.is_readable
    }
}

/// Compares a pair, and returns the result with the pictures that could be read. Errors become part
/// of the result.
pub fn compare(
    args: &DiffArgs,
    pair: Named,
    tolerance: &Tolerance<'_>,
) -> (Compared, [Option<FilePicture>; 2]) {
    let read = |path: &Option<_>, part| {
        let path: Option<&PathBuf> = path.as_ref();
        path.map(|path| files::picture(path, part)).transpose()
    };
    let reference = read(&pair.reference, "a reference");
    let actual = read(&pair.actual, "a picture");
    let is_readable = matches!(actual, Ok(Some(_)));
    let mut one = Compared {
        status: Status::Unreadable,
        text: String::new(),
        judged: None,
        fields: json!({}),
        notes: Vec::new(),
        time: Duration::ZERO,
        is_readable,
        pair,
    };
    let pictures = match (reference, actual) {
        (Ok(reference), Ok(actual)) => [reference, actual],
        (Err(one_error), Err(other)) => {
            one.text = format!("{one_error}; {other}");
            [None, None]
        }
        (Err(error), Ok(actual)) => {
            one.text = error.to_string();
            [None, actual]
        }
        (Ok(reference), Err(error)) => {
            one.text = error.to_string();
            [reference, None]
        }
    };
    for picture in pictures.iter().flatten() {
        one.notes.extend(picture.notes.iter().cloned());
    }
    match &pictures {
        _ if !one.text.is_empty() => {}
        [Some(reference), Some(actual)] => {
            if let Err(error) = judge(args, &mut one, [reference, actual], tolerance) {
                one.text = error.to_string();
            }
        }
        [Some(_), None] => {
            one.status = Status::Missing;
            one.text = format!("no picture {} in {}", one.pair.name, args.actual.display());
        }
        _ => {
            one.status = Status::New;
            one.text = format!("no reference {} yet", one.pair.place.display());
        }
    }
    (one, pictures)
}

/// Judges a pair of pictures.
fn judge(
    args: &DiffArgs,
    one: &mut Compared,
    [reference, actual]: [&FilePicture; 2],
    tolerance: &Tolerance<'_>,
) -> Result<(), CliError> {
    let pair = Pair::new(reference, actual, args.assume);
    one.notes
        .extend(pair.alpha_text(["the reference", "the picture"]));
    memory::check_pair(&pair)?;
    let found = Comparison::of(&pair, tolerance, Perceived::Metrics)?;
    let sizes = [reference.size(), actual.size()];
    found.add_to(&mut one.fields, &pair, sizes);
    let Some((difference, judged)) = found.result else {
        let [[rw, rh], [aw, ah]] = sizes;
        one.status = Status::Differs;
        one.text =
            format!("the sizes differ: {rw}x{rh} in the reference, {aw}x{ah} in the picture");
        return Ok(());
    };
    one.status = match (judged.fails, difference.equal) {
        (true, _) => Status::Differs,
        (_, false) => Status::Within,
        (_, true) => Status::Equal,
    };
    one.text = match one.status {
        Status::Equal => "equal".to_owned(),
        _ => found_text(&judged, tolerance),
    };
    one.judged = Some(judged);
    Ok(())
}

/// Describes a difference in one line.
fn found_text(judged: &Judged, tolerance: &Tolerance<'_>) -> String {
    let most = tolerance.threshold().unwrap_or(0.0);
    let largest = Levels(judged.judgement.largest);
    let (count, allowed) = (judged.count_text(), judged.allowed_text());
    format!("up to {largest}; over {most} levels {count}{allowed}")
}

/// Returns how many pairs have a status.
pub fn count(compared: &[Compared], status: Status) -> usize {
    compared.iter().filter(|one| one.status == status).count()
}

/// Returns the summary line: how many pairs have each status.
pub fn summary(compared: &[Compared]) -> String {
    let parts = Status::ALL.into_iter().rev().filter_map(|status| {
        let pairs = count(compared, status);
        let words = match status {
            Status::Within => "within what is allowed",
            Status::Differs if pairs == 1 => "differs",
            Status::Differs => "differ",
            status => status.name(),
        };
        (pairs > 0).then(|| format!("{} {words}", grouped(pairs)))
    });
    let parts: Vec<String> = parts.collect();
    let all = counted(compared.len(), "picture", "pictures");
    format!("{all}: {}", parts.join(", "))
}
