//! The pass over an OBJ file before its parser: every check that needs a line number, and text the parser can take.
//!
//! The parser (`tobj`) gives no line numbers and goes wrong on legal files: it refuses comments after a face and continued
//! lines, reads `l 1 2 3` as a triangle, divides by the weight of `v x y z w`, panics on a relative normal index
//! that is out of range, and starts again with other vertices at each `g`. So it is given positions, normals and faces only,
//! with absolute indices, as one group; groups, materials and smoothing are followed here.

use super::corner::{Entries, ObjCorner, WrittenCorner};
use super::error::{ObjProblem, quote};
use super::lines::{FREE_FORM, Statements, is_plain_number, keyword, without_comment};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::format;
use std::string::String;
use std::vec::Vec;

/// The largest mesh that is read: [`PolygonMesh`](crate::mesh::PolygonMesh)'s limits except in tests.
#[derive(Clone, Copy, Default)]
pub(super) struct MeshLimits {
    pub polygons: usize,
    pub corners: usize,
}

/// A thing that is passed over, or read in another way than it may be meant: one warning, however often it occurs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, thiserror::Error)]
enum Oddity {
    #[error("points and lines are not drawn")]
    PointOrLine,
    #[error("free-form curves and surfaces are not read, only polygons")]
    FreeForm,
    #[error("`call` and `csh` are not followed: the geometry that they would add is missing")]
    Call,
    #[error("is no OBJ statement and is passed over")]
    Unknown,
    #[error("a face of fewer than three different corners is left out")]
    SmallFace,
    #[error("a corner that repeats the one before it is left out")]
    RepeatedCorner,
    #[error("the weight w of a position is ignored")]
    Weight,
    #[error("a position has no colour: the colours of the others are not used")]
    NoColour,
    #[error(
        "the colour of a position is not within 0 to 1: what is shown is clamped at each pixel"
    )]
    ColourOutOfRange,
    #[error("a texture coordinate that does not exist is ignored, as all of them are")]
    NoTextureCoordinate,
    #[error(
        "a face names normals or texture coordinates, of which the file has none: they are passed over"
    )]
    UndeclaredNormal,
    #[error(
        "is no smoothing group and counts as `off`: expected a whole number from 0 on, `on` or `off`"
    )]
    NoSmoothingGroup,
}

/// The text for the parser, and all that the parser does not see.
#[derive(Default)]
pub(super) struct Prescan {
    /// The text for the parser.
    pub text: Vec<u8>,
    /// The number of polygons in it.
    pub polygons: usize,
    /// The number of corners of all of them.
    pub corners: usize,
    /// Each `o`: the first polygon that it holds for, and the name.
    pub object_runs: Vec<(usize, String)>,
    /// Each `s`: the first polygon that it holds for, and the group; 0 for `off`.
    pub smoothing_runs: Vec<(usize, u64)>,
    /// Each `usemtl`: the first polygon that it holds for, and the name; `None` for none.
    pub material_runs: Vec<(usize, Option<String>)>,
    /// The rest of each `mtllib`, with its line.
    pub libraries: Vec<(usize, String)>,
    limits: MeshLimits,
    positions: Entries,
    normals: Entries,
    texture_coordinates: usize,
    /// The first line that counts normals backwards before there is one, and the error about it.
    early_normal: Option<(usize, ObjProblem)>,
    /// The number of corners with a normal of their own.
    pub corners_with_normal: usize,
    /// The number of positions with a colour.
    colours: usize,
    /// True if the first position has a colour: the parser is then given one with each, white where there is none.
    writes_colours: bool,
    /// The first word that is no statement.
    unknown_word: String,
    /// The first word that is no smoothing group.
    unknown_group: String,
    /// The number of times that each occurs, and the first line.
    oddities: BTreeMap<Oddity, (usize, usize)>,
}

/// Reads all of `text`.
///
/// # Errors
/// The first line that is wrong, or `None` for the file as a whole, and the problem.
pub(super) fn prescan(
    text: &str,
    limits: MeshLimits,
) -> Result<Prescan, (Option<usize>, ObjProblem)> {
    let mut scan = Prescan {
        text: Vec::with_capacity(text.len()),
        limits,
        positions: Entries::new("position"),
        normals: Entries::new("normal"),
        ..Prescan::default()
    };
    let mut corners = Vec::new();
    for (line, statement) in Statements::new(text) {
        scan.statement(line, &statement, &mut corners)
            .map_err(|problem| (Some(line), problem))?;
    }
    // As for other loaders, a file without any normal may name them.
    let undeclared = scan.normals.count == 0;
    let missing = [
        scan.positions.missing(),
        scan.normals.missing().filter(|_| !undeclared),
        scan.early_normal.take().filter(|_| !undeclared),
    ];
    if let Some((line, problem)) = missing.into_iter().flatten().min_by_key(|(line, _)| *line) {
        return Err((Some(line), problem));
    }
    match scan.polygons {
        0 if scan.has(Oddity::PointOrLine) => Err((None, ObjProblem::OnlyPointsOrLines)),
        0 => Err((None, ObjProblem::NoPolygons)),
        _ => Ok(scan),
    }
}

impl Prescan {
    /// True if any corner has a normal.
    pub(super) fn has_normals(&self) -> bool {
        self.normals.count > 0 && self.corners_with_normal > 0
    }

    /// True if every position has a colour: only then the colours of the file are used.
    pub(super) fn has_colours(&self) -> bool {
        self.colours > 0 && !self.has(Oddity::NoColour)
    }

    /// Returns a line for each kind of thing that was passed over or read in another way than it may be meant.
    pub(super) fn warnings(&self) -> Vec<String> {
        let matters = |oddity: &Oddity| match oddity {
            Oddity::NoColour => self.colours > 0,
            Oddity::ColourOutOfRange => self.has_colours(),
            Oddity::UndeclaredNormal => self.normals.count == 0,
            Oddity::NoTextureCoordinate => {
                let is_told = self.normals.count == 0 && self.has(Oddity::UndeclaredNormal);
                self.texture_coordinates > 0 || !is_told
            }
            _ => true,
        };
        let oddities = self.oddities.iter().filter(|(oddity, _)| matters(oddity));
        oddities
            .map(|(oddity, &(count, first_line))| {
                let subject = match oddity {
                    Oddity::Unknown => format!("`{}` ", self.unknown_word),
                    Oddity::NoSmoothingGroup => format!("`s {}` ", self.unknown_group),
                    _ => String::new(),
                };
                match count {
                    1 => format!("{subject}{oddity} (line {first_line})"),
                    n => format!("{subject}{oddity} ({n} times, first in line {first_line})"),
                }
            })
            .collect()
    }

    fn has(&self, oddity: Oddity) -> bool {
        self.oddities.contains_key(&oddity)
    }

    fn note(&mut self, line: usize, oddity: Oddity) {
        self.oddities.entry(oddity).or_insert((0, line)).0 += 1;
    }

    fn statement(
        &mut self,
        line: usize,
        statement: &str,
        corners: &mut Vec<ObjCorner>,
    ) -> Result<(), ObjProblem> {
        let (written, rest) = keyword(statement);
        let mut word = Cow::Borrowed(written);
        if word.bytes().any(|byte| byte.is_ascii_uppercase()) {
            word = Cow::Owned(written.to_ascii_lowercase());
        }
        match &*word {
            "v" => self.position(line, rest)?,
            "vn" => {
                if self.normals.count == 0 {
                    self.text.extend_from_slice(b"vn 0 0 0\n");
                }
                self.vector("vn", rest)?;
                self.text.push(b'\n');
                self.normals.count += 1;
            }
            "vt" => self.texture_coordinates += 1,
            // Version 2 of the format called a face `fo`.
            "f" | "fo" => self.face(line, rest, corners)?,
            "usemtl" => {
                let name = (!rest.is_empty()).then(|| rest.into());
                self.material_runs.push((self.polygons, name));
            }
            "mtllib" => self.libraries.push((line, rest.into())),
            "o" => self.object_runs.push((self.polygons, rest.into())),
            "s" => {
                let group = self.smoothing_group(line, without_comment(rest));
                self.smoothing_runs.push((self.polygons, group));
            }
            "p" | "l" => self.note(line, Oddity::PointOrLine),
            // Names, groups, textures, levels of detail, display: nothing that shows in a picture of polygons.
            "g" | "mg" | "usemap" | "maplib" | "bevel" | "c_interp" | "d_interp" | "lod"
            | "shadow_obj" | "trace_obj" => {}
            "call" | "csh" => self.note(line, Oddity::Call),
            word if word.is_empty() || word.starts_with('#') => {}
            word if FREE_FORM.contains(&word) => self.note(line, Oddity::FreeForm),
            _ => {
                if !self.has(Oddity::Unknown) {
                    self.unknown_word = quote(written);
                }
                self.note(line, Oddity::Unknown);
            }
        }
        Ok(())
    }

    /// Reads a vector: three finite numbers, which are written for the parser, and others after them, which are checked.
    ///
    /// Returns the fourth to sixth number, 0 where there are fewer, and the number of all.
    fn vector(
        &mut self,
        keyword: &'static str,
        rest: &str,
    ) -> Result<([f32; 3], usize), ObjProblem> {
        let mut found = 0;
        let mut more = [0.0; 3];
        self.text.extend_from_slice(keyword.as_bytes());
        for word in without_comment(rest).split_ascii_whitespace() {
            found += 1;
            if found <= 3 {
                self.text.push(b' ');
                self.text.extend_from_slice(word.as_bytes());
                // The parser finds its value; most are plainly numbers, and need not be read twice.
                if is_plain_number(word) {
                    continue;
                }
            }
            let number = word.parse().ok().filter(|number: &f32| number.is_finite());
            let number = number.ok_or_else(|| ObjProblem::BadNumber {
                keyword,
                found: quote(word),
            })?;
            if (4..=6).contains(&found) {
                more[found - 4] = number;
            }
        }
        match found {
            3.. => Ok((more, found)),
            _ => Err(ObjProblem::TooFewNumbers { keyword, found }),
        }
    }

    /// Reads a position: three numbers, with a colour (three more) or a weight (one more), which is dropped.
    fn position(&mut self, line: usize, rest: &str) -> Result<(), ObjProblem> {
        let (more, found) = self.vector("v", rest)?;
        if found == 4 && more[0] != 1.0 {
            self.note(line, Oddity::Weight);
        }
        if found != 6 {
            self.note(line, Oddity::NoColour);
        } else {
            self.writes_colours |= self.positions.count == 0;
            self.colours += 1;
            if !more.iter().all(|channel| (0.0..=1.0).contains(channel)) {
                self.note(line, Oddity::ColourOutOfRange);
            }
        }
        if self.writes_colours {
            let [r, g, b] = if found == 6 { more } else { [1.0; 3] };
            self.text
                .extend_from_slice(format!(" {r} {g} {b}").as_bytes());
        }
        self.text.push(b'\n');
        self.positions.count += 1;
        Ok(())
    }

    fn face(
        &mut self,
        line: usize,
        rest: &str,
        corners: &mut Vec<ObjCorner>,
    ) -> Result<(), ObjProblem> {
        corners.clear();
        for word in without_comment(rest).split_ascii_whitespace() {
            corners.push(self.corner(line, word)?);
        }
        let written = corners.len();
        corners.dedup_by_key(|corner| corner.position);
        while corners.len() > 1 && corners[0].position == corners[corners.len() - 1].position {
            corners.pop();
        }
        if corners.len() < 3 {
            self.note(line, Oddity::SmallFace);
            return Ok(());
        }
        if corners.len() < written {
            self.note(line, Oddity::RepeatedCorner);
        }
        if self.polygons == self.limits.polygons {
            return Err(ObjProblem::TooManyPolygons);
        }
        if corners.len() > self.limits.corners - self.corners {
            return Err(ObjProblem::TooManyCorners);
        }
        self.polygons += 1;
        self.corners += corners.len();
        self.write_face(corners);
        Ok(())
    }

    /// Writes a face for the parser, whose first normal is zero and means none.
    ///
    /// Corners without a normal are given that one, unless none before them has another: the parser then takes its first
    /// normal by itself, and files without normals stay short.
    fn write_face(&mut self, corners: &[ObjCorner]) {
        self.text.push(b'f');
        for corner in corners {
            push_decimal(&mut self.text, b" ", corner.position + 1);
            if let Some(normal) = corner.normal {
                push_decimal(&mut self.text, b"//", normal + 2);
                self.corners_with_normal += 1;
            } else if self.corners_with_normal > 0 {
                self.text.extend_from_slice(b"//1");
            }
        }
        self.text.push(b'\n');
    }

    /// Returns the smoothing group that `rest` of an `s` names: 0 for `off`, 1 for `on`.
    fn smoothing_group(&mut self, line: usize, rest: &str) -> u64 {
        let word = rest.split_ascii_whitespace().next().unwrap_or_default();
        match (word.parse(), &*word.to_ascii_lowercase()) {
            (Ok(group), _) => group,
            (_, "on") => 1,
            (_, "off" | "null") => 0,
            _ => {
                if !self.has(Oddity::NoSmoothingGroup) {
                    self.unknown_group = quote(word);
                }
                self.note(line, Oddity::NoSmoothingGroup);
                0
            }
        }
    }

    fn corner(&mut self, line: usize, word: &str) -> Result<ObjCorner, ObjProblem> {
        let written = WrittenCorner::read(word)?;
        if let Some(index) = written.texture
            && (index == 0 || index.unsigned_abs() > self.texture_coordinates as u64)
        {
            self.note(line, Oddity::NoTextureCoordinate);
        }
        let position = self.positions.resolve(line, written.position)?;
        if self.normals.count == 0 && written.normal.is_some_and(|index| index != 0) {
            self.note(line, Oddity::UndeclaredNormal);
        }
        let normal = match written.normal {
            Some(index @ ..0) if self.normals.count == 0 => {
                let problem = || (line, self.normals.out_of_range(index));
                self.early_normal.get_or_insert_with(problem);
                None
            }
            Some(index) => Some(self.normals.resolve(line, index)?),
            None => None,
        };
        Ok(ObjCorner { position, normal })
    }
}

/// Appends a separator and `number` in decimal. Faster than `write!`, and there are as many numbers as corners.
fn push_decimal(text: &mut Vec<u8>, separator: &[u8], mut number: usize) {
    // 20 digits hold every 64-bit number.
    let mut digits = [0; 20];
    let mut start = digits.len();
    while number > 0 {
        start -= 1;
        digits[start] = b'0' + (number % 10) as u8;
        number /= 10;
    }
    text.extend_from_slice(separator);
    text.extend_from_slice(&digits[start..]);
}
