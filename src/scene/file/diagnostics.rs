//! Errors of scene files: what is wrong, where, and what was expected.

use annotate_snippets::{
    AnnotationKind, Group, Level, Origin as Path, Renderer, Snippet, normalize_untrusted_str,
};
use std::boxed::Box;
use std::fmt;
use std::format;
use std::ops::Range;
use std::path::PathBuf;
use std::string::{String, ToString};
use std::sync::Arc;
use std::vec::Vec;

/// Where a value was set. Errors about the value point there.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Origin {
    /// By the program.
    #[default]
    Program,
    /// In the scene file, at this range of bytes.
    File(Range<usize>),
    /// By this command-line flag, for example `--fovy`.
    Flag(String),
}

/// The path and the text of a scene file, kept so that errors can show its lines.
#[derive(Debug)]
pub(super) struct SourceText {
    /// The path, as the user wrote it.
    pub path: PathBuf,
    /// The contents of the file.
    pub text: String,
}

/// A scene that cannot be read or drawn.
///
/// `Display` is one line: the place in the file if there is one, the problem, and what was
/// expected. [`SceneError::render`] also shows the text of the file.
#[derive(Clone, Debug)]
pub struct SceneError(Box<Diagnostic>);

#[derive(Clone, Debug, Default)]
struct Diagnostic {
    title: String,
    expected: String,
    help: Option<String>,
    note: Option<String>,
    origin: Origin,
    related: Vec<(Range<usize>, String)>,
    source: Option<Arc<SourceText>>,
}

impl SceneError {
    /// Makes an error at `origin`. `title` says what is wrong, and `expected`, which may be empty,
    /// what should be there.
    pub(in crate::scene) fn new(
        origin: Origin,
        title: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        SceneError(Box::new(Diagnostic {
            title: title.into(),
            expected: expected.into(),
            origin,
            ..Diagnostic::default()
        }))
    }

    /// Adds the file whose lines are shown.
    pub(super) fn within(mut self, source: &Option<Arc<SourceText>>) -> Self {
        self.0.source = source.clone();
        self
    }

    /// Adds a hint.
    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// Adds a remark of several lines.
    pub(super) fn note(mut self, note: impl Into<String>) -> Self {
        self.0.note = Some(note.into());
        self
    }

    /// Points at a second place in the same file, if `origin` is in a file.
    pub(super) fn related(mut self, origin: &Origin, label: &str) -> Self {
        if let Origin::File(span) = origin {
            self.0.related.push((span.clone(), label.into()));
        }
        self
    }

    /// Returns line and column in the scene file, both counted from 1, the column in characters.
    /// Returns `None` if the error is not about a place in a file.
    pub fn line_and_column(&self) -> Option<(usize, usize)> {
        let span = self.span()?;
        let before = &self.0.source.as_ref()?.text[..span.start];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        Some((
            before.matches('\n').count() + 1,
            before[line_start..].chars().count() + 1,
        ))
    }

    /// Returns the range of bytes that the error is about, moved to character boundaries inside the
    /// text.
    fn span(&self) -> Option<Range<usize>> {
        let text = &self.0.source.as_ref()?.text;
        let Origin::File(span) = &self.0.origin else {
            return None;
        };
        let start = text.floor_char_boundary(span.start);
        Some(start..text.ceil_char_boundary(span.end).max(start))
    }

    /// Returns the problem, and what was expected if the error says so.
    fn sentence(&self) -> String {
        let gap = if self.0.expected.is_empty() { "" } else { ": " };
        format!("{}{gap}{}", self.0.title, self.0.expected)
    }

    /// Returns the error as text, with or without terminal colours.
    pub fn render(&self, colour: bool) -> String {
        let error = &*self.0;
        let span = self.span();
        let title = match span {
            Some(_) => normalize_untrusted_str(&error.title),
            None => normalize_untrusted_str(&self.sentence()),
        };
        let mut group = Group::with_title(Level::ERROR.primary_title(title));
        if let Some(source) = &error.source {
            let path = source.path.display().to_string();
            let mark = |kind: AnnotationKind, span: &Range<usize>, label: &str| {
                let label = normalize_untrusted_str(label);
                kind.span(span.clone()).label(label)
            };
            group = match span {
                None if matches!(error.origin, Origin::Flag(_)) => group,
                None => group.element(Path::path(path)),
                Some(span) => {
                    let here = mark(AnnotationKind::Primary, &span, &error.expected);
                    let others = error.related.iter();
                    let others = others.map(|(at, label)| mark(AnnotationKind::Context, at, label));
                    let snippet = Snippet::source(source.text.as_str()).path(path);
                    group.element(snippet.annotation(here).annotations(others))
                }
            };
        }
        if let Some(note) = &error.note {
            let lines: Vec<String> = note.lines().map(normalize_untrusted_str).collect();
            group = group.element(Level::NOTE.message(lines.join("\n")));
        }
        if let Some(help) = &error.help {
            group = group.element(Level::HELP.message(normalize_untrusted_str(help)));
        }
        if colour {
            Renderer::styled().render(&[group])
        } else {
            Renderer::plain().render(&[group])
        }
    }

    /// Makes the error for text that is not TOML.
    pub(super) fn from_toml(error: &toml::de::Error) -> Self {
        let origin = error.span().map_or(Origin::Program, Origin::File);
        let message = error.message();
        let (problem, expected) = message.split_once(", ").unwrap_or((message, ""));
        SceneError::new(origin, format!("not valid TOML: {problem}"), expected)
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let (Some(source), Some((line, column))) = (&self.0.source, self.line_and_column()) {
            write!(f, "{}:{line}:{column}: ", source.path.display())?;
        }
        f.write_str(&self.sentence())
    }
}

impl std::error::Error for SceneError {}
