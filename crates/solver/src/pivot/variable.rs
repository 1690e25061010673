//! The variables of Lemke's standard form.

/// A variable of Lemke's standard form; the number is the row of the boxed problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Variable {
    /// y, the distance of x from its bound.
    Y(usize),
    /// The complement of y: w or −w, excluding the part in v.
    W(usize),
    /// v, the force of the other bound.
    V(usize),
    /// The complement of v: the distance of x from the other bound.
    T(usize),
    /// Lemke's covering variable.
    Cover,
}

impl Variable {
    /// The complementary variable of its pair.
    pub(crate) fn partner(self) -> Self {
        match self {
            Variable::Y(i) => Variable::W(i),
            Variable::W(i) => Variable::Y(i),
            Variable::V(i) => Variable::T(i),
            Variable::T(i) => Variable::V(i),
            Variable::Cover => Variable::Cover,
        }
    }

    /// The same variable measured from the other bound of x, if there are two.
    pub(crate) fn mirrored(self) -> Self {
        match self {
            Variable::Y(i) => Variable::T(i),
            Variable::T(i) => Variable::Y(i),
            Variable::W(i) => Variable::V(i),
            Variable::V(i) => Variable::W(i),
            Variable::Cover => Variable::Cover,
        }
    }

    /// The row of the boxed problem; `None` for the covering variable.
    pub(crate) fn row(self) -> Option<usize> {
        match self {
            Variable::Y(i) | Variable::W(i) | Variable::V(i) | Variable::T(i) => Some(i),
            Variable::Cover => None,
        }
    }

    /// A unique number.
    pub(crate) fn number(self) -> usize {
        match self {
            Variable::Cover => 0,
            Variable::Y(i) => 4 * i + 1,
            Variable::W(i) => 4 * i + 2,
            Variable::V(i) => 4 * i + 3,
            Variable::T(i) => 4 * i + 4,
        }
    }
}

/// The place of a variable in a dictionary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    /// Basic, in this row.
    Row(usize),
    /// Nonbasic, in this column.
    Column(usize),
    /// Not in the dictionary.
    Nowhere,
}

/// The place of each variable.
#[derive(Debug, Clone)]
pub(crate) struct Places(Vec<Place>);

impl Places {
    /// The places of the variables in these rows and columns.
    pub(crate) fn of(basic: &[Variable], nonbasic: &[Variable]) -> Self {
        let rows = basic.iter().enumerate().map(|(r, &v)| (v, Place::Row(r)));
        let columns = nonbasic.iter().enumerate().map(|(c, &v)| (v, Place::Column(c)));
        let mut places = Places(Vec::new());
        rows.chain(columns).for_each(|(v, place)| places.put(v, place));
        places
    }

    pub(crate) fn get(&self, v: Variable) -> Place {
        self.0.get(v.number()).copied().unwrap_or(Place::Nowhere)
    }

    pub(crate) fn put(&mut self, v: Variable, place: Place) {
        if v.number() >= self.0.len() {
            self.0.resize(v.number() + 1, Place::Nowhere);
        }
        self.0[v.number()] = place;
    }
}
