//! Errors of scene files: what is wrong, where it stands, what was expected.

use super::value::Origin;
use crate::number::suggest;
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

/// The text of a scene file and its path, kept to show lines of it.
#[derive(Debug)]
pub struct SourceText {
    /// As the user named it.
    pub path: PathBuf,
    /// What the file says.
    pub text: String,
}

/// Why a scene cannot be read or drawn.
///
/// `Display` shows file, line, a caret and what was expected, without colours.
#[derive(Clone, Debug)]
pub struct SceneError(Box<Diagnostic>);

#[derive(Clone, Debug)]
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
    /// An error at `origin`: `title` says what is wrong, `expected` what should be there (may be empty).
    pub(super) fn new(
        source: Option<Arc<SourceText>>,
        origin: Origin,
        title: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        let (title, expected) = (title.into(), expected.into());
        SceneError(Box::new(Diagnostic {
            title,
            expected,
            help: None,
            note: None,
            origin,
            related: Vec::new(),
            source,
        }))
    }

    /// Adds a hint.
    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// Adds a remark of more than one line.
    pub(super) fn note(mut self, note: impl Into<String>) -> Self {
        self.0.note = Some(note.into());
        self
    }

    /// Points at a second place in the same file, if `origin` is one.
    pub(super) fn related(mut self, origin: &Origin, label: &str) -> Self {
        if let Origin::File(span) = origin {
            self.0.related.push((span.clone(), label.into()));
        }
        self
    }

    /// What is wrong, in one sentence.
    pub fn message(&self) -> &str {
        &self.0.title
    }

    /// What was expected instead; may be empty.
    pub fn expected(&self) -> &str {
        &self.0.expected
    }

    /// A hint, if there is one: what may have been meant.
    pub fn hint(&self) -> Option<&str> {
        self.0.help.as_deref()
    }

    /// Line and column in the scene file, both from 1, the column counted in characters; `None` for errors that do not
    /// stand in a file.
    pub fn line_and_column(&self) -> Option<(usize, usize)> {
        let span = self.span()?;
        let before = &self.0.source.as_ref()?.text[..span.start];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        Some((
            before.matches('\n').count() + 1,
            before[line_start..].chars().count() + 1,
        ))
    }

    /// The bytes that the error is about, kept inside the text and on character boundaries.
    fn span(&self) -> Option<Range<usize>> {
        let text = &self.0.source.as_ref()?.text;
        let Origin::File(span) = &self.0.origin else {
            return None;
        };
        let start = text.floor_char_boundary(span.start);
        Some(start..text.ceil_char_boundary(span.end).max(start))
    }

    /// The error as text, with terminal colours or without.
    pub fn render(&self, colour: bool) -> String {
        let error = &*self.0;
        let span = self.span();
        let title = match (&span, error.expected.is_empty()) {
            (Some(_), _) | (None, true) => normalize_untrusted_str(&error.title),
            (None, false) => {
                normalize_untrusted_str(&format!("{}: {}", error.title, error.expected))
            }
        };
        let mut group = Group::with_title(Level::ERROR.primary_title(title));
        if let Some(source) = &error.source {
            let path = source.path.display().to_string();
            group = match span {
                None if matches!(error.origin, Origin::Flag(_)) => group,
                None => group.element(Path::path(path)),
                Some(span) => group.element(
                    Snippet::source(source.text.as_str())
                        .path(path)
                        .annotation(
                            AnnotationKind::Primary
                                .span(span)
                                .label(normalize_untrusted_str(&error.expected)),
                        )
                        .annotations(error.related.iter().map(|(span, label)| {
                            AnnotationKind::Context
                                .span(span.clone())
                                .label(normalize_untrusted_str(label))
                        })),
                ),
            };
        }
        if let Some(note) = &error.note {
            group = group.element(
                Level::NOTE.message(
                    note.lines()
                        .map(normalize_untrusted_str)
                        .collect::<Vec<_>>()
                        .join("\n"),
                ),
            );
        }
        if let Some(help) = &error.help {
            group = group.element(Level::HELP.message(normalize_untrusted_str(help)));
        }
        let renderer = if colour {
            Renderer::styled()
        } else {
            Renderer::plain()
        };
        renderer.render(&[group])
    }

    /// What the TOML reader says of `source`, in this tool's words and with what may have been meant.
    pub(super) fn from_toml(error: &toml::de::Error, source: Arc<SourceText>) -> Self {
        let origin = error.span().map_or(Origin::Program, Origin::File);
        let message = error.message();
        // The reader passes serde's sentences on as text, so that they must be taken apart again.
        let parts = message.split_once(", ").unwrap_or((message, ""));
        for (unknown, name) in [
            ("unknown field `", "unknown key"),
            ("unknown variant `", "unknown word"),
        ] {
            if let Some(word) = parts
                .0
                .strip_prefix(unknown)
                .and_then(|rest| rest.strip_suffix('`'))
            {
                let candidates = quoted(parts.1);
                let error =
                    SceneError::new(Some(source), origin, format!("{name} `{word}`"), parts.1);
                if word == "depth_test" {
                    return error.help("what hides a polygon is said by `visibility`");
                }
                return match suggest::nearest(word, candidates) {
                    Some(nearest) => error.help(format!("did you mean `{nearest}`?")),
                    None => error,
                };
            }
        }
        if let Some(key) = message
            .strip_prefix("missing field `")
            .and_then(|rest| rest.strip_suffix('`'))
        {
            return SceneError::new(
                Some(source),
                origin,
                format!("the key `{key}` is missing"),
                "in this table",
            );
        }
        if let (Some(found), Some(expected)) = (
            parts.0.strip_prefix("invalid type: "),
            parts.1.strip_prefix("expected "),
        ) {
            return SceneError::new(
                Some(source),
                origin,
                format!("expected {expected}"),
                format!("found {found}"),
            );
        }
        SceneError::new(
            Some(source),
            origin,
            format!("not valid TOML: {}", parts.0),
            parts.1,
        )
    }
}

/// The words between backticks.
fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl std::error::Error for SceneError {}
