//! The comparison of one pair of pictures from two folders.

use super::super::text::{counted, grouped};
use super::super::tolerance::{Judged, Levels, Tolerance};
use super::super::{CliError, files, memory};
use super::DiffArgs;
use super::comparison::{Comparison, Perceived, encoding_text};
use super::pairing::Named;
use fastphong::picture::image_file::{FilePicture, Pair};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The outcome for a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// A picture cannot be read, or the pair cannot be compared.
    Unreadable,
    /// The pictures differ by more than is allowed, or in size.
    Differs,
    /// The stored values agree, but the pictures have different encodings.
    Encoding,
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
    pub const ALL: [Status; 7] = [
        Status::Unreadable,
        Status::Differs,
        Status::Encoding,
        Status::Missing,
        Status::New,
        Status::Within,
        Status::Equal,
    ];

    /// True if a pair with this status makes the comparison of the folders fail, unless it is
    /// approved.
    fn fails(self) -> bool {
        self < Status::Within
    }

    pub fn name(self) -> &'static str {
        match self {
            Status::Unreadable => "unreadable",
            Status::Differs => "differs",
            Status::Encoding => "encoding",
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
    /// The file of the picture, for `--approve`.
    pub file: Vec<u8>,
    /// True if the picture has become the reference.
    pub is_approved: bool,
}

impl Compared {
    /// True if this pair makes the comparison of the folders fail.
    pub fn fails(&self) -> bool {
        self.status.fails() && !self.is_approved
    }

    /// True if `--approve` copies the picture over its reference: only what was judged.
    pub fn can_be_approved(&self) -> bool {
        matches!(self.status, Status::Differs | Status::New)
    }
}

/// Compares a pair, and returns the result with the pictures that could be read. Errors become part
/// of the result.
pub fn compare(
    args: &DiffArgs,
    pair: Named,
    tolerance: &Tolerance<'_>,
) -> (Compared, [Option<FilePicture>; 2]) {
    let mut file = Vec::new();
    let mut errors = Vec::new();
    let mut read = |path: &Option<PathBuf>, part, keeps_file: bool| {
        let picture = path.as_ref().map(|path| {
            if keeps_file {
                let (picture, bytes) = files::picture_and_file(path, part)?;
                file = bytes;
                Ok(picture)
            } else {
                Ok(files::picture(path, part)?)
            }
        });
        picture.and_then(|picture: Result<_, CliError>| {
            picture.map_err(|error| errors.push(error.to_string())).ok()
        })
    };
    let pictures = [
        read(&pair.reference, "a reference", false),
        read(&pair.actual, "a picture", args.approve),
    ];
    let mut one = Compared {
        status: Status::Unreadable,
        text: errors.join("; "),
        judged: None,
        fields: json!({}),
        notes: Vec::new(),
        time: Duration::ZERO,
        file,
        is_approved: false,
        pair,
    };
    for picture in pictures.iter().flatten() {
        one.notes.extend(picture.notes.iter().cloned());
    }
    match &pictures {
        _ if !one.text.is_empty() => {}
        [Some(reference), Some(actual)] => {
            if let Err(error) = judge(args, &mut one, reference, actual, tolerance) {
                one.text = error.to_string();
            }
        }
        [Some(_), None] => {
            let (name, folder) = (&one.pair.name, args.actual.display());
            let place = one.pair.place.display();
            one.status = Status::Missing;
            one.text = format!(
                "no picture {name} in {folder}: expected one, or no reference: remove {place}"
            );
        }
        _ if files::is_file(&one.pair.place) => {
            let (place, problem) = (one.pair.place.display(), "is there, but was not listed");
            let expected = if files::has_changed(&one.pair.place) {
                "it came after that: expected no change meanwhile"
            } else {
                "expected no link to a folder, and the same name"
            };
            one.text = format!("{place} {problem}: {expected}");
        }
        _ if let Some(link) = linked_folder(&args.reference, &one.pair.place) => {
            let (place, link) = (one.pair.place.display(), link.display());
            one.text = format!("no reference {place}, and {link} is a link: expected a folder");
        }
        [_, picture] => {
            // A mask or a region that fits no picture must not wait for the first comparison.
            let size = picture.as_ref().map(FilePicture::size);
            match size.map(|size| tolerance.selection(size)) {
                Some(Err(error)) => one.text = error.to_string(),
                _ => {
                    one.status = Status::New;
                    one.text = format!("no reference {} yet", one.pair.place.display());
                }
            }
        }
    }
    (one, pictures)
}

/// Returns the link among the folders between `root` and `place`, if there is one. What is written
/// behind it would be outside of `root`.
fn linked_folder<'a>(root: &Path, place: &'a Path) -> Option<&'a Path> {
    let folders = place.ancestors().skip(1);
    let mut inner = folders.take_while(|folder| *folder != root);
    inner.find(|folder| folder.is_symlink())
}

/// Judges a pair of pictures.
fn judge(
    args: &DiffArgs,
    one: &mut Compared,
    reference: &FilePicture,
    actual: &FilePicture,
    tolerance: &Tolerance<'_>,
) -> Result<(), CliError> {
    let pair = Pair::new(reference, actual, args.assume);
    one.notes
        .extend(pair.alpha_text(["the reference", "the picture"]));
    memory::check_pair(&pair)?;
    let sizes = [reference.size(), actual.size()];
    let found = Comparison::of(&pair, tolerance, Perceived::Metrics);
    if let Ok(found) = &found {
        found.add_to(&mut one.fields, &pair, sizes);
    }
    if let Some(text) = encoding_text(found.as_ref().ok(), &pair, tolerance) {
        (one.status, one.text) = (Status::Encoding, text);
        return Ok(());
    }
    let Some((difference, judged)) = found?.result else {
        let [[rw, rh], [aw, ah]] = sizes;
        // A mask that fits neither picture is the fault.
        let of_reference = tolerance.selection(sizes[0]);
        of_reference.or_else(|_| tolerance.selection(sizes[1]))?;
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
            Status::Encoding => "in another encoding",
            status => status.name(),
        };
        (pairs > 0).then(|| format!("{} {words}", grouped(pairs)))
    });
    let parts: Vec<String> = parts.collect();
    let all = counted(compared.len(), "picture", "pictures");
    format!("{all}: {}", parts.join(", "))
}
