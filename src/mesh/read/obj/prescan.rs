//! The pass over an OBJ file before its parser: every check that needs a line number, and text the parser can take.
//!
//! The parser (`tobj`) gives no line numbers and goes wrong on legal files: it refuses comments after a face and continued
//! lines, reads `l 1 2 3` as a triangle, divides by the weight of `v x y z w`, panics on a relative normal index
//! that is out of range, and starts again with other vertices at each `g`. So it is given positions, normals and faces only,
//! with absolute indices, as one group; groups, materials and smoothing are followed here.

use super::super::polygons::look_like_bytes;
use super::corner::{Entries, ObjCorner, WrittenCorner};
use super::error::{ObjProblem, VectorProblem, quote};
use super::lines::{
    FREE_FORM, Statements, is_plain_number, keyword, line_number, read_number, without_comment,
};
use glam::Vec3;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::format;
use std::str::SplitAsciiWhitespace;
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
    #[error("polypaint (`#MRGB`, colours in comments) is not read")]
    Polypaint,
    #[error("the weight w of a position is ignored")]
    Weight,
    #[error("a position is not three finite numbers and is left out")]
    BadPosition,
    #[error("a normal is not three finite numbers: corners that name it count as without a normal")]
    BadNormal,
    #[error("a normal that no face uses is passed over")]
    UnusedNormal,
    #[error("a corner names a normal that does not exist and counts as without a normal")]
    NoNormal,
    #[error("a face uses a position that has no colour: the colours of the others are not used")]
    NoColour,
    #[error(
        "a face uses a position whose colour is not within 0 to 1: what is shown is clamped at each pixel"
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
    /// The number of normals so far.
    normals: usize,
    /// The number of normals in the file, once that is known: a corner may name one before its line.
    all_normals: Option<usize>,
    /// One more than the largest number of a normal that a corner names.
    named_normals: usize,
    /// The line of each normal; 0 for those that a face names.
    unused_normals: Vec<u32>,
    texture_coordinates: usize,
    /// The number of corners with a normal of their own.
    pub corners_with_normal: usize,
    /// Positions that are not three finite numbers.
    bad_positions: Vec<BadPosition>,
    /// The line of the first face that uses each position; 0 if none does.
    first_uses: Vec<u32>,
    /// The positions in the order in which faces first use them: that of the parser's mesh.
    pub used_positions: Vec<u32>,
    /// The colour of each position up to the last one that has a colour; [`NO_COLOUR`] for the others.
    colours: Vec<Vec3>,
    /// The first word that is no statement.
    unknown_word: String,
    /// The first word that is no smoothing group.
    unknown_group: String,
    /// The number of times that each occurs, and the first line.
    oddities: BTreeMap<Oddity, (usize, usize)>,
}

/// A position that is not three finite numbers.
struct BadPosition {
    /// Its index, counted from 0.
    index: usize,
    line: usize,
    problem: VectorProblem,
}

const NO_COLOUR: Vec3 = Vec3::NAN;

/// The reason why a file is refused.
pub(super) struct Refusal {
    /// The first line that is wrong; `None` for the file as a whole.
    pub line: Option<usize>,
    pub problem: ObjProblem,
    /// What was odd before.
    pub warnings: Vec<String>,
}

/// Reads all of `text`.
///
/// # Errors
/// For the first line that is wrong, or the file as a whole.
pub(super) fn prescan(text: &str, limits: MeshLimits) -> Result<Prescan, Refusal> {
    let scan = scan(text, limits, None)?;
    let normals = scan.normals;
    // Nearly no file names normals that it does not have; one without any may, as for other loaders.
    match scan.named_normals > normals && normals > 0 {
        true => self::scan(text, limits, Some(normals)),
        false => Ok(scan),
    }
}

/// Reads all of `text`, which has `all_normals` if they were counted already.
fn scan(text: &str, limits: MeshLimits, all_normals: Option<usize>) -> Result<Prescan, Refusal> {
    let mut scan = Prescan {
        text: Vec::with_capacity(text.len()),
        limits,
        all_normals,
        ..Prescan::default()
    };
    let mut corners = Vec::new();
    for (line, statement) in Statements::new(text) {
        if let Err(problem) = scan.statement(line, &statement, &mut corners) {
            return Err(scan.refusal(Some(line), problem));
        }
    }
    if let Some((line, problem)) = scan.wrong_index() {
        return Err(scan.refusal(Some(line), problem));
    }
    scan.check_colours();
    for number in 0..scan.unused_normals.len().min(scan.normals) {
        match scan.unused_normals[number] {
            0 => {}
            line => scan.note(line as usize, Oddity::UnusedNormal),
        }
    }
    match scan.polygons {
        // A text may have a NUL that does no harm. With words that are no statements it is no text.
        0 if scan.has(Oddity::Unknown) && text.contains('\0') => {
            let at = text.find('\0').unwrap_or_default();
            Err(Refusal {
                line: Some(line_number(text, at)),
                problem: ObjProblem::NotText,
                warnings: Vec::new(),
            })
        }
        0 if scan.unknown_word.eq_ignore_ascii_case("newmtl") => {
            let what = "a material library, and not the mesh that names it";
            Err(scan.refusal(None, ObjProblem::OtherFile(what)))
        }
        0 if scan.has(Oddity::PointOrLine) => {
            Err(scan.refusal(None, ObjProblem::OnlyPointsOrLines))
        }
        0 => Err(scan.refusal(None, ObjProblem::NoPolygons)),
        _ => Ok(scan),
    }
}

impl Prescan {
    /// True if any corner has a normal.
    pub(super) fn has_normals(&self) -> bool {
        self.normals > 0 && self.corners_with_normal > 0
    }

    /// True if the colours that faces use look like those from 0 to 255.
    pub(super) fn has_colours_like_bytes(&self) -> bool {
        let colours = self.used_positions.iter().map(|&at| self.colour(at));
        self.has(Oddity::ColourOutOfRange)
            && !self.has(Oddity::NoColour)
            && look_like_bytes(colours)
    }

    /// Returns the colours of the positions that faces use, in the order of the parser's mesh; `None` if they are not all there.
    pub(super) fn used_colours(&self) -> Option<Vec<Vec3>> {
        // A surface does not reflect less than nothing.
        let colour = |&at: &u32| self.colour(at).max(Vec3::ZERO);
        let colours = self.used_positions.iter().map(colour);
        let is_whole = !self.colours.is_empty() && !self.has(Oddity::NoColour);
        is_whole.then(|| colours.collect())
    }

    fn colour(&self, position: u32) -> Vec3 {
        let colour = self.colours.get(position as usize);
        colour.copied().unwrap_or(NO_COLOUR)
    }

    /// Makes the error for `problem`, with what was odd before.
    fn refusal(&mut self, line: Option<usize>, problem: ObjProblem) -> Refusal {
        if let ObjProblem::BadPosition { .. } = problem {
            self.oddities.remove(&Oddity::BadPosition);
        }
        Refusal {
            line,
            problem,
            warnings: self.warnings(),
        }
    }

    /// Returns the first line that names what the whole file does not have, or that is named and cannot be read, and the
    /// problem.
    fn wrong_index(&self) -> Option<(usize, ObjProblem)> {
        let face = |bad: &BadPosition| {
            let face = self.first_uses.get(bad.index).copied();
            face.filter(|&face| face > 0).map(|face| face as usize)
        };
        let bad_position = self.bad_positions.iter().find_map(|bad| {
            let (face, problem) = (face(bad)?, bad.problem.clone());
            Some((bad.line, ObjProblem::BadPosition { problem, face }))
        });
        let wrong = [bad_position, self.positions.missing()];
        wrong.into_iter().flatten().min_by_key(|(line, _)| *line)
    }

    /// Looks at the colours of the positions that faces use. If none of them has one, the file counts as without colours.
    fn check_colours(&mut self) {
        let mut used = self.used_positions.iter();
        if used.all(|&position| self.colour(position).is_nan()) {
            self.colours.clear();
            return;
        }
        for number in 0..self.used_positions.len() {
            let position = self.used_positions[number];
            let face = self.first_uses[position as usize] as usize;
            let colour = self.colour(position);
            if colour.is_nan() {
                self.note(face, Oddity::NoColour);
            } else if colour.min_element() < 0.0 || colour.max_element() > 1.0 {
                self.note(face, Oddity::ColourOutOfRange);
            }
        }
    }

    /// Returns a line for each kind of thing that was passed over or read in another way than it may be meant.
    pub(super) fn warnings(&self) -> Vec<String> {
        let matters = |oddity: &Oddity| match oddity {
            Oddity::ColourOutOfRange => !self.has(Oddity::NoColour),
            Oddity::UndeclaredNormal => self.normals == 0,
            Oddity::NoNormal => self.normals > 0,
            Oddity::NoTextureCoordinate => {
                let is_told = self.normals == 0 && self.has(Oddity::UndeclaredNormal);
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
            "v" => self.position(line, rest),
            "vn" => {
                if self.normals == 0 {
                    self.text.extend_from_slice(b"vn 0 0 0\n");
                }
                let mut words = without_comment(rest).split_ascii_whitespace();
                if self.vector("vn", &mut words).is_err() {
                    self.note(line, Oddity::BadNormal);
                }
                self.text.push(b'\n');
                self.normals += 1;
                self.note_normal(self.normals - 1, line);
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
            "#mrgb" => self.note(line, Oddity::Polypaint),
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

    /// Writes the first three of `words` for the parser: finite numbers, or a NaN in place of all if they are not.
    ///
    /// # Errors
    /// When they are not. The word that is wrong is the last one taken from `words`.
    fn vector(
        &mut self,
        keyword: &str,
        words: &mut SplitAsciiWhitespace,
    ) -> Result<(), VectorProblem> {
        let start = self.text.len();
        let mut problem = None;
        self.text.extend_from_slice(keyword.as_bytes());
        for found in 0..3 {
            let Some(word) = words.next() else {
                problem = Some(VectorProblem::TooFewNumbers { found });
                break;
            };
            // The parser finds its value; most are plainly numbers, and need not be read twice.
            if !is_plain_number(word) && !word.parse().is_ok_and(f32::is_finite) {
                let found = quote(word);
                problem = Some(VectorProblem::BadNumber { found });
                break;
            }
            self.text.push(b' ');
            self.text.extend_from_slice(word.as_bytes());
        }
        let Some(problem) = problem else {
            return Ok(());
        };
        self.text.truncate(start);
        self.text.extend_from_slice(keyword.as_bytes());
        self.text.extend_from_slice(b" nan nan nan");
        Err(problem)
    }

    /// Reads a position: three numbers, with a colour (three more) or a weight (one more), which is dropped. What follows a
    /// colour is not looked at.
    fn position(&mut self, line: usize, rest: &str) {
        let mut words = without_comment(rest).split_ascii_whitespace();
        let read = self.vector("v", &mut words);
        if let Err(problem) = read.and_then(|()| self.colour_or_weight(line, &mut words)) {
            self.note(line, Oddity::BadPosition);
            self.bad_positions.push(BadPosition {
                index: self.positions.count,
                line,
                problem,
            });
        }
        self.text.push(b'\n');
        self.positions.count += 1;
    }

    /// Reads the words after the three numbers of a position.
    ///
    /// # Errors
    /// When one of them is no number: two lines that ran together are no position.
    fn colour_or_weight(
        &mut self,
        line: usize,
        words: &mut SplitAsciiWhitespace,
    ) -> Result<(), VectorProblem> {
        let mut numbers = [f32::NAN; 3];
        let mut found = 0;
        for (number, word) in numbers.iter_mut().zip(words) {
            let problem = || VectorProblem::BadNumber { found: quote(word) };
            *number = read_number(word).ok_or_else(problem)?;
            found += 1;
        }
        let colour = Vec3::from_array(numbers);
        if found == 1 && numbers[0] != 1.0 {
            self.note(line, Oddity::Weight);
        }
        if found == 3 && colour.is_finite() {
            self.colours.resize(self.positions.count, NO_COLOUR);
            self.colours.push(colour);
        }
        Ok(())
    }

    fn face(
        &mut self,
        line: usize,
        rest: &str,
        corners: &mut Vec<ObjCorner>,
    ) -> Result<(), ObjProblem> {
        let words = without_comment(rest).split_ascii_whitespace();
        // What is left out in any case may name what is not there: the file may be cut off here.
        if words.clone().nth(2).is_none() {
            // But `f 1\2\3` is cut off nowhere.
            if let Some(word) = words.clone().find(|word| word.contains('\\')) {
                self.corner(line, word)?;
            }
            self.note(line, Oddity::SmallFace);
            return Ok(());
        }
        corners.clear();
        for word in words {
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
        self.note_uses(line, corners);
        self.write_face(corners);
        Ok(())
    }

    /// Notes which positions a face in `line` is the first to use.
    fn note_uses(&mut self, line: usize, corners: &[ObjCorner]) {
        let line = u32::try_from(line).unwrap_or(u32::MAX);
        for position in corners.iter().map(|corner| corner.position) {
            if position >= self.first_uses.len() {
                // A position takes two bytes or more: one so far ahead does not come.
                if position >= self.text.capacity().max(self.positions.count) {
                    continue;
                }
                self.first_uses.resize(position + 1, 0);
            }
            if self.first_uses[position] == 0 {
                self.first_uses[position] = line;
                self.used_positions.push(position as u32);
            }
        }
    }

    /// Notes the line of a normal, or 0 for one that a face names, before or after its line.
    fn note_normal(&mut self, normal: usize, line: usize) {
        if normal >= self.unused_normals.len() {
            // A normal takes two bytes or more: one so far ahead does not come.
            if normal >= self.text.capacity().max(self.normals) {
                return;
            }
            self.unused_normals.resize(normal + 1, u32::MAX);
        } else if self.unused_normals[normal] == 0 {
            return;
        }
        self.unused_normals[normal] = u32::try_from(line).unwrap_or(u32::MAX);
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
                self.note_normal(normal, 0);
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
        let normal = written.normal.and_then(|index| self.normal(line, index));
        Ok(ObjCorner { position, normal })
    }

    /// Returns the normal, counted from 0, that `index` names; `None` if there is none, which is told.
    fn normal(&mut self, line: usize, index: i64) -> Option<usize> {
        if self.normals == 0 {
            self.note(line, Oddity::UndeclaredNormal);
        }
        let number = usize::try_from(index.unsigned_abs()).ok();
        let named = number.and_then(|number| match index {
            ..0 => self.normals.checked_sub(number),
            _ => number.checked_sub(1),
        });
        let named = named.filter(|named| self.all_normals.is_none_or(|all| *named < all));
        match named {
            Some(named) => self.named_normals = self.named_normals.max(named.saturating_add(1)),
            None => self.note(line, Oddity::NoNormal),
        }
        named
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
