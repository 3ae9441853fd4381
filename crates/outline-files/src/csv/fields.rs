//! Entries of a line.

/// Separator of the entries of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Separator {
    /// A semicolon or tab, next to which a comma is a decimal mark.
    Sign(char),
    Comma,
    Blanks,
}

impl Separator {
    /// Returns the separator of a line.
    pub(super) fn of(line: &str) -> Self {
        let outside = |sign: char| {
            let mut quoted = false;
            line.chars().any(|c| {
                quoted ^= c == '"';
                c == sign && !quoted
            })
        };
        match [';', '\t', ','].into_iter().find(|sign| outside(*sign)) {
            Some(',') => Self::Comma,
            Some(sign) => Self::Sign(sign),
            None => Self::Blanks,
        }
    }

    fn ends(self, sign: char) -> bool {
        match self {
            Self::Sign(own) => sign == own,
            Self::Comma => sign == ',',
            Self::Blanks => sign.is_whitespace(),
        }
    }
}

/// An entry of a line, without quotation marks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Field<'a> {
    pub(super) text: &'a str,
    /// True if it stands in quotation marks.
    pub(super) quoted: bool,
    separator: Separator,
}

impl Field<'_> {
    /// Returns true for a number with a comma as its decimal mark.
    pub(super) fn has_decimal_comma(&self) -> bool {
        let (text, sign) = (self.text, matches!(self.separator, Separator::Sign(_)));
        sign && !text.contains('.') && text.matches(',').count() == 1 && text.replace(',', ".").parse::<f64>().is_ok()
    }

    /// Returns the number.
    pub(super) fn number(&self) -> Option<f64> {
        if self.has_decimal_comma() { self.text.replace(',', ".").parse().ok() } else { self.text.parse().ok() }
    }

    /// Returns true for a number, also with marks that cannot be read.
    pub(super) fn looks_like_a_number(&self) -> bool {
        let marks = self.text.trim_matches(|sign: char| sign.is_ascii_digit() || "+-.,".contains(sign)).is_empty();
        self.text.parse::<f64>().is_ok() || (marks && self.text.contains(|sign: char| sign.is_ascii_digit()))
    }

    /// Returns true for a whole number without a sign.
    pub(super) fn is_whole(&self) -> bool {
        !self.text.is_empty() && self.text.bytes().all(|byte| byte.is_ascii_digit())
    }
}

/// Returns the entries of a line. Separators within quotation marks do not count, and neither do empty entries at the
/// end.
pub(super) fn fields(line: &str, separator: Separator) -> Vec<Field<'_>> {
    let mut found = Vec::new();
    let (mut start, mut within) = (0, false);
    let ends = line.char_indices().filter(|&(_, sign)| {
        within ^= sign == '"';
        !within && separator.ends(sign)
    });
    for (end, length) in ends.map(|(at, sign)| (at, sign.len_utf8())).chain([(line.len(), 0)]) {
        let part = line[start..end].trim();
        start = end + length;
        if separator != Separator::Blanks || !part.is_empty() {
            found.push(Field { text: part.trim_matches('"').trim(), quoted: part.starts_with('"'), separator });
        }
    }
    while found.last().is_some_and(|last| last.text.is_empty()) {
        found.pop();
    }
    found
}
