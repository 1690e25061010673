// Checks proofs about linear complementarity problems. Written from docs/proofs.md alone; calculates with BigInt.
//
//     node lcpcheck.js PROBLEM PROOF [MODEL]   prints what it proves, or why it is rejected; MODEL is
//                                              the friction model to ask about, if not the problem's
//     node lcpcheck.js FOLDER                  every *.proof.json of a folder, about the problem of
//                                              its hash in another *.json
//
// Exit code: 0 if every proof proves its claim, 1 if one is rejected, 2 if a problem cannot be read.
// In a page: lcpcheck(problemText, proofText) returns { holds, says }.
"use strict";

const lcpcheck = (() => {
  class Refused extends Error {}
  const need = (holds, reason) => { if (!holds) throw new Refused(reason); };

  // ---- JSON (RFC 8259) in which no object has a key twice; a number keeps its text, for an index
  class Numeral { constructor(text) { this.text = text; this.value = Number(text); } }
  function read(text) {
    let at = 0, depth = 0;
    const token = (pattern) => {
      pattern.lastIndex = at;
      const found = pattern.exec(text);
      if (found !== null) at = pattern.lastIndex;
      return found === null ? null : found[0];
    };
    const next = () => { token(/[ \t\n\r]*/y); return text[at]; };
    const take = (character) => { need(next() === character, "no JSON"); at += 1; };
    const string = () => {
      const start = at;
      need(text[at] === '"', "no JSON");
      for (at += 1; at < text.length && text[at] !== '"'; at += 1) if (text[at] === "\\") at += 1;
      at += 1;
      const value = JSON.parse(text.slice(start, at));
      need(!/\p{Surrogate}/u.test(value), "half of a surrogate pair");
      return value;
    };
    // The members between two brackets.
    const members = (open, close, member) => {
      take(open);
      need((depth += 1) <= 127, "more than 127 brackets within each other");
      for (let isFirst = true; next() !== close; isFirst = false) {
        if (!isFirst) take(",");
        next();
        member();
      }
      at += 1;
      depth -= 1;
    };
    const value = () => {
      const first = next();
      if (first === '"') return string();
      if (first === "[") {
        const list = [];
        members("[", "]", () => list.push(value()));
        return list;
      }
      if (first === "{") {
        const object = Object.create(null);
        members("{", "}", () => {
          const key = string();
          need(!has(object, key), "a key twice");
          take(":");
          object[key] = value();
        });
        return object;
      }
      const word = token(/true|false|null/y);
      if (word !== null) return JSON.parse(word);
      const numeral = token(/-?(?:0|[1-9][0-9]*)(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?/y);
      need(numeral !== null && Number.isFinite(Number(numeral)), "no JSON, or a number that is not finite");
      return new Numeral(numeral);
    };
    const whole = value();
    need(next() === undefined, "no JSON");
    return whole;
  }
  const has = (object, key) => Object.prototype.hasOwnProperty.call(object, key);
  const isObject = (v) => typeof v === "object" && v !== null && !Array.isArray(v) && !(v instanceof Numeral);
  const hasKeys = (v, keys) =>
    isObject(v) && Object.keys(v).length === keys.length && keys.every((key) => has(v, key));
  const number = (v) => {
    need(v instanceof Numeral, "a number");
    return v.value + 0;
  };
  const size = (v) => {
    need(number(v) >= 0, "a number that is not negative");
    return number(v);
  };
  const index = (v, n) => {
    need(v instanceof Numeral && /^(0|[1-9][0-9]*)$/.test(v.text) && v.value < n, "an index");
    return v.value;
  };
  const list = (v, n) => {
    need(Array.isArray(v) && (n === undefined || v.length === n), "a list of another length");
    return v;
  };
  function integer(v) {
    need(typeof v === "string" && /^(0|-?[1-9a-f][0-9a-f]*)$/.test(v), "an integer");
    return v[0] === "-" ? -BigInt("0x" + v.slice(1)) : BigInt("0x" + v);
  }

  // ---- a binary64 as m 2^e
  function parts(v) {
    const view = new DataView(new ArrayBuffer(8));
    view.setFloat64(0, v);
    const bits = view.getBigUint64(0);
    const exponent = Number((bits >> 52n) & 2047n), fraction = bits & ((1n << 52n) - 1n);
    let m = exponent === 0 ? fraction : fraction | (1n << 52n), e = Math.max(exponent, 1) - 1075;
    if (m === 0n) return [0n, 0];
    while ((m & 1n) === 0n) { m >>= 1n; e += 1; }
    return [v < 0 ? -m : m, e];
  }
  // Integers and s: the numbers times 2^s.
  const whole = (values) => scaled(values.map(parts));
  function scaled(all) {
    const s = all.reduce((most, [, e]) => Math.max(most, -e), 0);
    return [all.map(([m, e]) => m << BigInt(e + s)), BigInt(s)];
  }
  const abs = (v) => (v < 0n ? -v : v);
  const max = (a, b) => (a > b ? a : b);

  // ---- SHA-256 (FIPS 180-4)
  function sha256(bytes) {
    const primes = [], isPrime = (n) => { for (let d = 2; d * d <= n; d++) if (n % d === 0) return false; return true; };
    for (let n = 2; primes.length < 64; n++) if (isPrime(n)) primes.push(n);
    // The first 32 bits of the fractional parts of roots, exactly: ⌊root · 2^32⌋ mod 2^32.
    const root = (n, k) => {
      const target = BigInt(n) << BigInt(32 * k);
      let low = 0n, high = 1n << 42n;
      while (high - low > 1n) {
        const middle = (low + high) >> 1n;
        if (middle ** BigInt(k) <= target) low = middle; else high = middle;
      }
      return Number(low & 0xffffffffn);
    };
    const K = primes.map((p) => root(p, 3)), H = primes.slice(0, 8).map((p) => root(p, 2));
    const length = (bytes.length + 9 + 63) & ~63, data = new Uint8Array(length), view = new DataView(data.buffer);
    data.set(bytes);
    data[bytes.length] = 128;
    view.setBigUint64(length - 8, BigInt(bytes.length) * 8n);
    const turn = (x, n) => (x >>> n) | (x << (32 - n)), w = new Int32Array(64);
    for (let block = 0; block < length; block += 64) {
      for (let t = 0; t < 16; t++) w[t] = view.getInt32(block + 4 * t);
      for (let t = 16; t < 64; t++) {
        const a = turn(w[t - 15], 7) ^ turn(w[t - 15], 18) ^ (w[t - 15] >>> 3);
        const b = turn(w[t - 2], 17) ^ turn(w[t - 2], 19) ^ (w[t - 2] >>> 10);
        w[t] = w[t - 16] + a + w[t - 7] + b;
      }
      let [a, b, c, d, e, f, g, h] = H;
      for (let t = 0; t < 64; t++) {
        const s1 = turn(e, 6) ^ turn(e, 11) ^ turn(e, 25), s0 = turn(a, 2) ^ turn(a, 13) ^ turn(a, 22);
        const one = (h + s1 + ((e & f) ^ (~e & g)) + K[t] + w[t]) | 0;
        const two = (s0 + ((a & b) ^ (a & c) ^ (b & c))) | 0;
        [h, g, f, e, d, c, b, a] = [g, f, e, (d + one) | 0, c, b, a, (one + two) | 0];
      }
      [a, b, c, d, e, f, g, h].forEach((v, k) => { H[k] = (H[k] + v) | 0; });
    }
    return H.map((v) => (v >>> 0).toString(16).padStart(8, "0")).join("");
  }

  // ---- the problem
  // The binary64 nearest to the sum of several: exact, and rounded once.
  function sum(values) {
    const [terms, s] = whole(values), m = terms.reduce((sum, m) => sum + m, 0n), all = abs(m);
    // the exponent of the last binary digit that is kept
    const last = Math.max(all.toString(2).length - 53 - Number(s), -1074);
    const cut = BigInt(last) + s;
    if (cut <= 0n) return Number(m) * 2 ** -Number(s);
    const kept = all >> cut, rest = all - (kept << cut), half = 1n << (cut - 1n);
    const isUp = rest > half || (rest === half && (kept & 1n) === 1n);
    return Number(isUp ? kept + 1n : kept) * 2 ** last * (m < 0n ? -1 : 1);
  }
  // The rows of a matrix by rising column, without zeros; and whether no place is there twice.
  function place(triplets, rows, columns) {
    const places = Array.from({ length: rows }, () => new Map());
    for (const triplet of list(triplets)) {
      const [i, j, v] = list(triplet, 3), row = places[index(i, rows)], column = index(j, columns);
      row.set(column, [...(row.get(column) ?? []), number(v)]);
    }
    const total = (values) => (values.length === 1 ? values[0] : sum(values));
    const matrix = places.map((row) => [...row].map(([j, values]) => [j, total(values)])
      .filter(([, v]) => v !== 0).sort((p, q) => p[0] - q[0]));
    need(matrix.every((row) => row.every(([, v]) => Number.isFinite(v))), "a sum that is not finite");
    return [matrix, places.reduce((sum, row) => sum + row.size, 0) === triplets.length];
  }

  // The key motion: M, J, bias, compliance, u*.
  function bodies(data, n) {
    const level = isObject(data) && has(data, "level") ? ["level"] : [];
    need(hasKeys(data, ["mass", "jacobian", "bias", "compliance", "target", ...level]), "the keys of motion");
    need(level.length === 0 || ["velocity", "acceleration"].includes(data.level), "level");
    const target = list(data.target).map(number), k = target.length;
    const bias = list(data.bias, n).map(number), soft = list(data.compliance, n).map(size);
    const [mass, isOnce] = place(data.mass, k, k), [jacobian, too] = place(data.jacobian, n, k);
    need(isOnce && too, "two triplets at one place");
    need(data.mass.every(([i, j]) => i.value <= j.value), "an entry below the diagonal");
    return { mass, jacobian, bias, soft, target };
  }

  const BOXES = ["coupled-box", "frozen-box"], CONES = ["associated-cone", "coulomb-cone"];
  const MODELS = [...BOXES, ...CONES];
  for (let k = 4; k <= 256; k += 4) MODELS.push(`polygon-${k}`);

  // A problem, under another friction model than the one that it states if one is asked for.
  function problem(data, asked) {
    need(isObject(data) && isObject(data.A) && has(data.A, "dense") !== has(data.A, "triplets"), "A and b");
    const b = list(data.b).map(number), n = b.length;
    let rows;
    need(Object.keys(data.A).every((key) => ["dense", "triplets", "rows", "cols"].includes(key)), "A has an unknown key");
    need(["rows", "cols"].every((key) => !has(data.A, key) || index(data.A[key], n + 1) === n), "A has another size");
    if (has(data.A, "dense")) {
      const row = (row) => list(row, n).map((v, j) => [j, number(v)]).filter(([, v]) => v !== 0);
      rows = list(data.A.dense, n).map(row);
    } else {
      need(has(data.A, "rows") && has(data.A, "cols"), "A has no size");
      [rows] = place(data.A.triplets, n, n);
    }
    const vector = (key, read, other) => (has(data, key) ? list(data[key], n).map(read) : b.map((_, i) => other(i)));
    need(has(data, "friction_index") === has(data, "mu"), "friction_index and mu belong together");
    let owner = vector("friction_index", (k) => (k instanceof Numeral && k.text === "-1" ? -1 : index(k, n)), () => -1);
    let mu = vector("mu", number, () => 0).map((v, i) => (owner[i] < 0 ? 0 : v));
    const words = new Map([["inf", Infinity], ["+inf", Infinity], ["-inf", -Infinity]]);
    const bound = (v) => words.get(v) ?? number(v);
    const lo = vector("lo", bound, (i) => (owner[i] < 0 ? 0 : -Infinity)), hi = vector("hi", bound, () => Infinity);
    const scale = has(data, "scale") ? number(data.scale) : 0;
    need(scale > 0 || !has(data, "scale"), "scale");
    for (let i = 0; i < n; i++) {
      need(lo[i] <= hi[i] && lo[i] < Infinity && hi[i] > -Infinity, `the bounds of row ${i}`);
      const k = owner[i];
      if (k < 0) continue;
      need(owner[k] < 0 && lo[k] >= 0 && mu[i] >= 0, `the friction of row ${i}`);
      need(lo[i] === -Infinity && hi[i] === Infinity, `the bounds of row ${i}`);
    }
    const frozen = vector("frozen_at", number, () => 0);
    const stated = has(data, "model") ? [data.model] : [];
    let model = asked ?? stated[0] ?? "coupled-box";
    need([model, ...stated].every((name) => MODELS.includes(name)), "a model that is not known");
    const coupled = owner.filter((k) => k >= 0), normals = new Set(coupled);
    if (coupled.length > 0 && normals.size === coupled.length && !["frozen-box", "associated-cone"].includes(model)) {
      // One tangent a contact: in the plane the cone is the box.
      model = "coupled-box";
    } else if (asked !== undefined || has(data, "model")) {
      need(normals.size > 0, "a friction model without friction");
      for (const k of normals) {
        const tangents = mu.filter((_, i) => owner[i] === k);
        need(tangents.length === 2 && tangents[0] === tangents[1], `the contact of row ${k}`);
        need(lo[k] === 0 && hi[k] === Infinity, `the contact of row ${k}`);
      }
    }
    if (model === "frozen-box") {
      need(has(data, "frozen_at"), "frozen_at");
      owner.forEach((k, i) => {
        if (k < 0) return;
        hi[i] = mu[i] * Math.max(frozen[k], 0);
        lo[i] = -hi[i];
      });
      [owner, mu] = [owner.map(() => -1), mu.map(() => 0)];
    }
    const [values, sa] = whole(rows.flatMap((row) => row.map(([, v]) => v)));
    let next = 0;
    const A = rows.map((row) => row.map(([j]) => [j, values[next++]]));
    const [B, sb] = whole(b), [M, sm] = whole(mu);
    const [ends, sl] = whole([...lo, ...hi].map((v) => (Number.isFinite(v) ? v : 0)));
    const end = (k, v) => (Number.isFinite(v) ? ends[k] : null);
    const L = lo.map((v, i) => end(i, v)), U = hi.map((v, i) => end(n + i, v));

    const motion = has(data, "motion") ? bodies(data.motion, n) : null;
    const sizeOf = (matrix) => matrix.reduce((sum, row) => sum + 4 + 12 * row.length, 0);
    const size = 17 + 12 + sizeOf(rows) + 36 * n + 4 + (motion === null ? 0
      : 4 + sizeOf(motion.mass) + sizeOf(motion.jacobian) + 16 * n + 8 * motion.target.length)
      + (model === "coupled-box" ? 0 : 4 + model.length);
    const bytes = new Uint8Array(size), view = new DataView(bytes.buffer);
    let at = 17;
    const put4 = (v) => { view.setUint32(at, v); at += 4; };
    const put8 = (v) => { view.setFloat64(at, v + 0); at += 8; };
    const ascii = (text) => Array.from(text, (c) => c.charCodeAt(0));
    bytes.set(ascii("lcplab problem 1\n"));
    put4(n);
    put8(scale);
    const putRow = (row) => {
      put4(row.length);
      for (const [j, v] of row) { put4(j); put8(v); }
    };
    rows.forEach(putRow);
    for (const vector of [b, lo, hi]) vector.forEach(put8);
    owner.forEach((k, i) => { put4(k < 0 ? 0 : k + 1); put8(mu[i]); });
    put4(motion === null ? 0 : 1);
    if (motion !== null) {
      put4(motion.target.length);
      [motion.mass, motion.jacobian].forEach((matrix) => matrix.forEach(putRow));
      [motion.bias, motion.soft, motion.target].forEach((vector) => vector.forEach(put8));
    }
    if (model !== "coupled-box") {
      put4(model.length);
      bytes.set(ascii(model), at);
    }
    // The rows n, t1, t2 of each contact with a cone, and the rows of none.
    const owners = CONES.includes(model) ? [...new Set(owner.filter((k) => k >= 0))].sort((i, j) => i - j) : [];
    const contacts = owners.map((k) => [k, ...b.keys()].filter((i, at) => at === 0 || owner[i] === k));
    const others = [...b.keys()].filter((i) => !contacts.flat().includes(i));
    return { contacts, others, n, biased: n, A, B, M, L, U, owner, sa, sb, sl, sm, motion, model, least: parts(scale), hash: sha256(bytes) };
  }

  // x times D, and D, from a point of a proof.
  function point(p, data) {
    need(hasKeys(data, ["denominator", "numerators"]), "a point");
    const d = integer(data.denominator), given = list(data.numerators, p.n), x = Array(p.n).fill(0n);
    need(d > 0n, "a denominator");
    const first = [...x.keys()].filter((i) => p.owner[i] < 0), then = [...x.keys()].filter((i) => p.owner[i] >= 0);
    for (const i of [...first, ...then]) {
      const side = given[i];
      if (side !== "lo" && side !== "hi") x[i] = integer(side) << (p.sl + p.sm);
      else if (p.owner[i] < 0) {
        const bound = side === "lo" ? p.L[i] : p.U[i];
        need(bound !== null, `row ${i} has no such bound`);
        x[i] = (bound * d) << p.sm;
      } else {
        const reach = (p.M[i] * max(x[p.owner[i]], 0n)) >> p.sm;
        x[i] = side === "lo" ? -reach : reach;
      }
    }
    return [x, d << (p.sl + p.sm)];
  }

  function solution(p, data) {
    const [x, D] = point(p, data);
    const slips = p.A.map((row, i) => {
      const sum = row.reduce((sum, [j, a]) => sum + a * x[j], 0n);
      return (sum << p.sb) + ((p.B[i] * D) << p.sa);
    });
    for (const contact of p.contacts) law(p, contact, contact.map((i) => x[i]), contact.map((i) => slips[i]));
    p.others.forEach((i) => {
      const w = slips[i], k = p.owner[i];
      const reach = k < 0 ? 0n : p.M[i] * max(x[k], 0n), own = x[i] << (k < 0 ? p.sl : p.sm);
      const lo = k >= 0 ? -reach : p.L[i] === null ? null : p.L[i] * D;
      const hi = k >= 0 ? reach : p.U[i] === null ? null : p.U[i] * D;
      need((lo === null || lo <= own) && (hi === null || own <= hi), `x of row ${i} is beyond a bound`);
      need((w <= 0n || own === lo) && (w >= 0n || own === hi), `w of row ${i} has the wrong sign`);
    });
    return [x, D];
  }

  // The law of a contact with a cone, at its x times D and its w times D and a power of two.
  function law(p, [n, t1], [x, x1, x2], [w, w1, w2]) {
    const mu = p.M[t1], friction = (x1 * x1 + x2 * x2) << (2n * p.sm), limit = mu * x * mu * x;
    const power = x1 * w1 + x2 * w2;
    need(x >= 0n && friction <= limit && w >= 0n, `the contact of row ${n} is outside its cone, or penetrates`);
    if (p.model === "coulomb-cone") {
      const isStill = w1 === 0n && w2 === 0n;
      need(x === 0n || w === 0n, `the contact of row ${n} pushes while it opens`);
      need(isStill || (friction === limit && x1 * w2 === x2 * w1 && power <= 0n), `the friction of the contact of row ${n}`);
    } else {
      need((w * w) << (2n * p.sm) >= mu * mu * (w1 * w1 + w2 * w2), `the contact of row ${n} is outside its dual cone`);
      need(x * w + power === 0n, `the contact of row ${n} does work`);
    }
  }

  // The problem of the exact bodies, whose unknowns are x and then the motion u.
  function augmented(p) {
    need(p.motion !== null, "the problem says nothing of bodies");
    const { mass, jacobian, bias, soft, target } = p.motion, n = p.n, k = target.length, width = n + k;
    const rows = Array.from({ length: width }, () => new Map());
    soft.forEach((v, i) => { if (v !== 0) rows[i].set(i, v); });
    jacobian.forEach((row, i) => row.forEach(([j, v]) => { rows[i].set(n + j, v); rows[n + j].set(i, -v); }));
    mass.forEach((row, i) => row.forEach(([j, v]) => { rows[n + i].set(n + j, v); rows[n + j].set(n + i, v); }));
    // −Σ M u*: a sum of products as m 2^e.
    const load = (row) => {
      const terms = [...row].filter(([j]) => j >= n).map(([j, v]) => [parts(v), parts(target[j - n])]);
      const [products, s] = scaled(terms.map(([v, u]) => [v[0] * u[0], v[1] + u[1]]));
      return [-products.reduce((sum, m) => sum + m, 0n), -Number(s)];
    };
    const [B, sb] = scaled([...bias.map(parts), ...rows.slice(n).map(load)]);
    const [values, sa] = whole(rows.flatMap((row) => [...row.values()]));
    let next = 0;
    const A = rows.map((row) => [...row.keys()].map((j) => [j, values[next++]]));
    const extra = (list, v) => [...list, ...Array(k).fill(v)];
    const others = [...p.others, ...Array.from({ length: k }, (_, j) => n + j)];
    return { ...p, n: width, biased: n, A, sa, B, sb, M: extra(p.M, 0n), L: extra(p.L, null), U: extra(p.U, null), owner: extra(p.owner, -1), others };
  }

  // The redundant rows of a proof: each depends on rows with w = 0 that are not redundant, up to a change of b.
  function redundant(p, data, unknown, change) {
    need(isObject(data), "redundant");
    const row = (key) => {
      need(/^(0|[1-9][0-9]*)$/.test(key), "a row");
      return Number(key);
    };
    const isStill = (i) => unknown.has(i) && unknown.get(i)[0] === "still", rows = new Set(Object.keys(data).map(row));
    for (const i of rows) {
      const own = data[String(i)], sums = new Map();
      need(isStill(i) && isObject(own) && has(own, String(i)), `the dependence of row ${i}`);
      let total = 0n;
      for (const key of Object.keys(own)) {
        const j = row(key), f = integer(own[key]);
        need(f !== 0n && (j === i || (isStill(j) && !rows.has(j))), `the dependence of row ${i} on row ${j}`);
        total += f * p.B[j];
        p.A[j].forEach(([column, a]) => sums.set(column, (sums.get(column) ?? 0n) + f * a));
      }
      need([...sums.values()].every((v) => v === 0n), `row ${i} does not depend on the others`);
      const [m, e] = parts(i < p.biased ? change : 0), most = binary([m * abs(integer(own[String(i)])), e + Number(p.sb)]);
      need(abs(total) * most[1] <= most[0], `b of row ${i} does not depend on the others`);
    }
    return rows;
  }

  // The box of a proof, which must contain a solution of a problem with cones: [center, radius, D],
  // the first two times D.
  function region(p, proof) {
    const states = list(proof.states, p.n), [X, D] = point(p, proof.center), S = p.sa + p.sb + p.sm + p.sl;
    const R = list(proof.radius, p.n).map((r) => integer(r) << (p.sl + p.sm));
    // The numbers of the problem times T.
    const T = 1n << S, A = p.A.map((row) => row.map(([j, a]) => [j, a << (S - p.sa)])), mu = p.M.map((m) => m << (S - p.sm));
    const [lo, hi] = [p.L, p.U].map((ends) => ends.map((end) => (end === null ? null : end << (S - p.sl))));
    const isOneOf = (state, names) => typeof state === "string" && names.includes(state);
    // The equation of each unknown row.
    const unknown = new Map();
    for (const i of p.others) {
      need(isOneOf(states[i], ["lo", "free", "hi"]), `the state of row ${i}`);
      if (states[i] === "free") unknown.set(i, ["still", [i, i, i]]);
    }
    for (const contact of p.contacts) {
      const [n, t1, t2] = contact, state = states[n], hasFriction = mu[t1] > 0n;
      need(isOneOf(state, ["open", "sticks", "slides"]), `the state of row ${n}`);
      need(states[t1] === state && states[t2] === state, `the states of the contact of row ${n}`);
      need(state !== "sticks" || hasFriction, `the contact of row ${n} has no friction`);
      if (state === "sticks") contact.forEach((i) => unknown.set(i, ["still", contact]));
      if (state !== "slides") continue;
      unknown.set(n, [hasFriction && p.model === "associated-cone" ? "power" : "still", contact]);
      if (hasFriction) unknown.set(t1, ["limit", contact]).set(t2, ["parallel", contact]);
    }
    const change = has(proof, "bias_change") ? size(proof.bias_change) : 0;
    const fixed = redundant(p, has(proof, "redundant") ? proof.redundant : {}, unknown, change);
    fixed.forEach((i) => unknown.delete(i));
    for (let i = 0; i < p.n; i++) {
      const isUnknown = unknown.has(i), end = states[i] === "lo" ? lo[i] : states[i] === "hi" ? hi[i] : 0n;
      need(isUnknown ? R[i] > 0n : R[i] === 0n, `the radius of row ${i}`);
      need(isUnknown || fixed.has(i) || (end !== null && X[i] * T === end * D), `the center of row ${i}`);
    }
    // w, and how much it changes in the box, times T D.
    const W = A.map((row, i) => row.reduce((sum, [j, a]) => sum + a * X[j], (p.B[i] << (S - p.sb)) * D));
    const P = A.map((row) => row.reduce((sum, [j, a]) => sum + abs(a) * R[j], 0n));
    const rows = [...unknown.keys()].sort((i, j) => i - j), total = (terms) => terms.reduce((sum, v) => sum + v, 0n);
    // F and its curvature times T^2 D^2, its derivatives times T^2 D.
    const equations = rows.map((i) => {
      const [kind, contact] = unknown.get(i), [n, t1, t2] = contact, own = new Map();
      const add = (j, v) => own.set(j, (own.get(j) ?? 0n) + v);
      const addRow = (k, factor) => A[k].forEach(([j, a]) => add(j, factor * a * T));
      if (kind === "still") {
        addRow(i, D);
        return { f: W[i] * T * D, own, q: 0n };
      }
      if (kind === "power") {
        contact.forEach((k) => { addRow(k, X[k]); add(k, W[k] * T); });
        return { f: total(contact.map((k) => X[k] * W[k])) * T, own, q: total(contact.map((k) => R[k] * P[k])) * T };
      }
      if (kind === "limit") {
        const square = (v) => (v[t1] ** 2n + v[t2] ** 2n) * T * T, limit = (v) => (mu[t1] * v[n]) ** 2n;
        add(n, -2n * mu[t1] * mu[t1] * X[n]);
        [t1, t2].forEach((t) => add(t, 2n * X[t] * T * T));
        return { f: square(X) - limit(X), own, q: square(R) + limit(R) };
      }
      addRow(t2, X[t1]);
      addRow(t1, -X[t2]);
      add(t1, W[t2] * T);
      add(t2, -W[t1] * T);
      return { f: (X[t1] * W[t2] - X[t2] * W[t1]) * T, own, q: (R[t1] * P[t2] + R[t2] * P[t1]) * T };
    });
    // The nonzero derivatives of each unknown.
    const columns = rows.map((j) => equations.flatMap(({ own }, k) => (own.get(j) ? [[k, own.get(j)]] : [])));
    list(proof.inverse, rows.length).forEach((row, at) => {
      const [C, e] = whole(list(row, rows.length).map(number)), one = (T * T * D) << e;
      let image = abs(total(C.map((c, k) => c * equations[k].f))) + 2n * total(C.map((c, k) => abs(c) * equations[k].q));
      rows.forEach((j, column) => {
        let rest = column === at ? one : 0n;
        columns[column].forEach(([k, v]) => { rest -= C[k] * v; });
        image += abs(rest) * R[j];
      });
      need(image < R[rows[at]] * one, `the box is not mapped into itself in row ${rows[at]}`);
    });
    for (const i of p.others) {
      const isInside = () => (lo[i] === null || (X[i] - R[i]) * T >= lo[i] * D) && (hi[i] === null || (X[i] + R[i]) * T <= hi[i] * D);
      const holds = states[i] === "lo" ? W[i] >= P[i] : states[i] === "hi" ? -W[i] >= P[i] : isInside();
      need(holds, `row ${i} breaks an inequality of its state`);
    }
    for (const [n, t1, t2] of p.contacts) {
      const m = mu[t1], least = X[n] - R[n], tangents = [t1, t2], state = states[n];
      const most = (v, spread) => total(tangents.map((t) => (abs(v[t]) + spread[t]) ** 2n)), rise = W[n] - P[n];
      const power = () => total(tangents.map((t) => X[t] * W[t] + abs(X[t]) * P[t] + R[t] * abs(W[t]) + R[t] * P[t]));
      const isDual = () => p.model === "coulomb-cone" || (rise * T) ** 2n >= m * m * most(W, P);
      const holds = state === "open" ? rise >= 0n && isDual()
        : state === "sticks" ? least >= 0n && most(X, R) * T * T <= (m * least) ** 2n
        : m === 0n ? least >= 0n : least > 0n && power() <= 0n;
      need(holds, `the contact of row ${n} breaks an inequality of its state`);
    }
    return [X, R, D];
  }

  // Whether all leading principal minors are positive: they are the pivots of Bareiss' elimination.
  function isPositive(m) {
    let last = 1n;
    for (let c = 0; c < m.length; c++) {
      const own = m[c], pivot = own[c];
      if (pivot <= 0n) return false;
      for (let r = c + 1; r < m.length; r++) {
        const f = m[r][c];
        for (let j = c; j < m.length; j++) m[r][j] = (m[r][j] * pivot - f * own[j]) / last;
      }
      last = pivot;
    }
    return true;
  }

  function unique(p, by) {
    need(p.owner.every((k) => k < 0), "rows are coupled");
    const full = p.A.map((row) => {
      const dense = Array(p.n).fill(0n);
      row.forEach(([j, a]) => { dense[j] = a; });
      return dense;
    });
    if (by === "definite") {
      need(p.n <= 500, "more than 500 rows");
      need(isPositive(full.map((row, i) => row.map((a, j) => a + full[j][i]))), "A + A' is not positive definite");
      return;
    }
    need(by === "p-matrix" && p.n <= 12, "by");
    for (let size = 1; size <= p.n; size++) {
      for (let set = 1; set < 1 << p.n; set++) {
        const rows = [...full.keys()].filter((i) => (set >> i) & 1);
        if (rows.length === size) need(isPositive(rows.map((i) => rows.map((j) => full[i][j]))), "a minor");
      }
    }
  }

  function tree(p, data, sides) {
    need(isObject(data), "a tree");
    if (hasKeys(data, ["d"])) return leaf(p, data.d, sides);
    const i = index(data.row, p.n);
    need(!sides.has(i) && sides.size < 100, "a branch");
    const ways = ["free"];
    if (p.owner[i] >= 0 || p.L[i] !== null) ways.push("lo");
    if (p.owner[i] >= 0 || p.U[i] !== null) ways.push("hi");
    need(hasKeys(data, ["row", ...ways]), `the sides of row ${i}`);
    for (const side of ways) tree(p, data[side], new Map([...sides, [i, side]]));
  }

  function leaf(p, data, sides) {
    need(isObject(data), "a d");
    const c = Array(p.n).fill(0n);          // times 2^(sa + sm)
    let total = 0n;                         // times 2^(sa + sb + sl + sm)
    for (const [key, value] of Object.entries(data)) {
      need(/^(0|[1-9][0-9]*)$/.test(key) && Number(key) < p.n, "a row of d");
      const i = Number(key), d = integer(value), side = sides.get(i), isCoupled = p.owner[i] >= 0;
      const mayFall = side === "hi" || side === "free" || (side === undefined && !isCoupled && p.L[i] === null);
      const mayRise = side === "lo" || side === "free" || (side === undefined && !isCoupled && p.U[i] === null);
      need((d >= 0n || mayFall) && (d <= 0n || mayRise), `the sign of d in row ${i}`);
      for (const [j, a] of p.A[i]) c[j] += (a * d) << p.sm;
      total += (p.B[i] * d) << (p.sa + p.sl + p.sm);
    }
    p.owner.forEach((k, j) => {
      if (k < 0) return;
      const side = sides.get(j), own = side === "lo" ? -c[j] : side === "hi" ? c[j] : abs(c[j]);
      c[k] += (p.M[j] * own) >> p.sm;
    });
    p.owner.forEach((k, j) => {
      if (k >= 0 || c[j] === 0n) return;
      const side = sides.get(j), isUp = side === "hi" || (side !== "lo" && c[j] > 0n);
      const bound = isUp ? p.U[j] : p.L[j];
      need(bound !== null, `nothing bounds the product in row ${j}`);
      total += (c[j] * bound) << p.sb;
    });
    need(total < 0n, "the vector of a case shows nothing");
  }

  // ---- fractions [p, q] with q > 0
  const gcd = (a, b) => { a = abs(a); b = abs(b); while (b) [a, b] = [b, a % b]; return a; };
  const fraction = (p, q) => { const g = q < 0n ? -gcd(p, q) : gcd(p, q); return [p / g, q / g]; };
  const plus = (a, b) => fraction(a[0] * b[1] + b[0] * a[1], a[1] * b[1]);
  const times = (a, b) => fraction(a[0] * b[0], a[1] * b[1]);
  const over = (a, b) => fraction(a[0] * b[1], a[1] * b[0]);
  const negative = ([p, q]) => [-p, q], absolute = ([p, q]) => [abs(p), q];
  const less = (a, b) => a[0] * b[1] < b[0] * a[1];
  const larger = (a, b) => (less(a, b) ? b : a), smaller = (a, b) => (less(a, b) ? a : b);
  const binary = ([m, e]) => (e >= 0 ? [m << BigInt(e), 1n] : fraction(m, 1n << BigInt(-e)));

  // The scaled residual of an answer.
  function residual(p, answer) {
    const x = answer.map((v) => binary(parts(v))), zero = [0n, 1n], least = binary(p.least);
    const rows = p.A.map((row, i) => {
      const terms = [...row.map(([j, a]) => times(fraction(a, 1n << p.sa), x[j])), fraction(p.B[i], 1n << p.sb)];
      const own = row.find(([j]) => j === i), most = row.reduce((most, [, a]) => max(most, abs(a)), 0n);
      const s = fraction(own ? abs(own[1]) : most, 1n << p.sa);
      const ends = [p.L[i], p.U[i]].filter((v) => v !== null).reduce((most, v) => max(most, abs(v)), 0n);
      return {
        w: terms.reduce(plus, zero),
        T: larger(terms.map(absolute).reduce(plus, zero), times(s, least)),
        s: s[0] === 0n ? [1n, 1n] : s,
        R: ends === 0n ? null : larger(fraction(ends, 1n << p.sl), least),
      };
    });
    const unit = ({ T, s }, R) => (R === null ? over(T, s) : smaller(over(T, s), R));
    return rows.reduce((worst, row, i) => {
      const k = p.owner[i], end = (v) => (v === null ? null : fraction(v, 1n << p.sl));
      let own = x[i], [lo, hi, R] = [end(p.L[i]), end(p.U[i]), row.R];
      if (k >= 0) {
        const mu = fraction(p.M[i], 1n << p.sm);
        hi = times(mu, larger(x[k], zero));
        lo = negative(hi);
        const reach = times(mu, larger(x[k], unit(rows[k], rows[k].R)));
        R = reach[0] === 0n ? null : reach;
        const near = times(hi, [1n, 1n << 50n]);
        own = [lo, hi].find((v) => !less(near, absolute(plus(own, negative(v))))) ?? own;
      }
      const e = unit(row, R), step = row.T[0] === 0n ? zero : over(times(e, row.w), row.T);
      let target = plus(own, negative(step));
      if (lo !== null) target = larger(target, lo);
      if (hi !== null) target = smaller(target, hi);
      const miss = absolute(plus(own, negative(target)));
      need(e[0] > 0n || miss[0] === 0n, "the residual is not finite");
      return miss[0] === 0n ? worst : larger(worst, over(miss, e));
    }, zero);
  }

  // S and G of an answer and a motion.
  // The forces of a proof about cones, as fractions; each is inside its cone or its bounds.
  function forces(p, data) {
    need(isObject(data) && list(data.numerators).every((v) => v !== "lo" && v !== "hi"), "forces");
    const [X, D] = point(p, data);
    for (const [n, t1, t2] of p.contacts) {
      const limit = p.M[t1] * X[n];
      need(X[n] >= 0n && (X[t1] * X[t1] + X[t2] * X[t2]) << (2n * p.sm) <= limit * limit, `the force of row ${n} is outside its cone`);
    }
    for (const i of p.others) {
      const own = X[i] << p.sl;
      need((p.L[i] === null || p.L[i] * D <= own) && (p.U[i] === null || own <= p.U[i] * D), `the force of row ${i}`);
    }
    return X.map((v) => fraction(v, D));
  }

  // g of a contact, from the mu, force, w and compliance of its rows.
  function coneGap(mu, force, w, give, n) {
    const sum = (terms) => terms.reduce(plus, [0n, 1n]), square = (v) => times(v, v);
    if (w.every((v) => v[0] === 0n)) return [0n, 1n];
    const costs = [], limit = times(square(mu), plus(square(w[1]), square(w[2])));
    if (w[0][0] >= 0n && !less(square(w[0]), limit)) costs.push(sum(w.map((v, k) => times(v, force[k]))));
    if (give.every((v) => v[0] > 0n)) costs.push(sum(w.map((v, k) => over(square(v), times([2n, 1n], give[k])))));
    need(costs.length > 0, `the motion breaks the contact of row ${n}`);
    return costs.reduce(smaller);
  }

  // S and G; under a cone, force replaces the projected answer.
  function squares(p, answer, data, force) {
    const exact = (v) => binary(parts(v)), zero = [0n, 1n], minus = (a, b) => plus(a, negative(b));
    const { mass, jacobian, bias, soft, target } = p.motion, k = target.length, x = answer.map(exact);
    need(hasKeys(data, ["denominator", "numerators"]), "a motion");
    const D = integer(data.denominator);
    need(D > 0n, "a denominator");
    const v = list(data.numerators, k).map((N) => fraction(integer(N), D));
    const moved = v.map((v, j) => minus(v, exact(target[j])));
    const beyond = Array(k).fill(zero), within = Array(k).fill(zero);
    const add = (f, j, term) => { f[j] = plus(f[j], term); };
    mass.forEach((row, i) => row.forEach(([j, m]) => {
      add(within, i, times(exact(m), moved[j]));
      if (i !== j) add(within, j, times(exact(m), moved[i]));
    }));
    const slips = [];
    let S = zero, G = zero;
    jacobian.forEach((row, i) => {
      let [lo, hi] = [p.L[i], p.U[i]].map((end) => (end === null ? null : fraction(end, 1n << p.sl)));
      if (p.owner[i] >= 0) {
        hi = times(fraction(p.M[i], 1n << p.sm), larger(x[p.owner[i]], zero));
        lo = negative(hi);
      }
      let inside = x[i];
      if (lo !== null) inside = larger(inside, lo);
      if (hi !== null) inside = smaller(inside, hi);
      if (force !== null) inside = force[i];
      const give = exact(soft[i]);
      const w = row.reduce((w, [j, a]) => plus(w, times(exact(a), v[j])), plus(exact(bias[i]), times(give, inside)));
      slips.push(w);
      const isOfContact = p.contacts.some((contact) => contact.includes(i));
      const end = w[0] > 0n ? lo : hi, costs = isOfContact ? [zero] : [];
      if (end !== null && !isOfContact) costs.push(absolute(times(minus(inside, end), w)));
      if (give[0] > 0n && !isOfContact) costs.push(over(times(w, w), times([2n, 1n], give)));
      need(costs.length > 0 || w[0] === 0n, `the motion breaks row ${i}`);
      if (w[0] !== 0n) G = plus(G, times([2n, 1n], costs.reduce(smaller)));
      row.forEach(([j, a]) => {
        add(within, j, negative(times(exact(a), inside)));
        add(beyond, j, times(exact(a), minus(x[i], inside)));
      });
    });
    for (const contact of p.contacts) {
      const of = (values) => contact.map((i) => values[i]), mu = fraction(p.M[contact[1]], 1n << p.sm);
      G = plus(G, times([2n, 1n], coneGap(mu, of(force), of(slips), of(soft).map(exact), contact[0])));
    }
    // M = L D L'; both vectors become their L^-1 f
    const left = mass.map((row) => new Map(row.map(([j, m]) => [j, exact(m)])));
    left.forEach((row, c) => {
      const pivot = row.get(c) ?? zero;
      need(pivot[0] > 0n, "the mass matrix is not positive definite");
      S = plus(S, over(times(beyond[c], beyond[c]), pivot));
      G = plus(G, over(times(within[c], within[c]), pivot));
      for (const [r, value] of row) {
        if (r === c) continue;
        const factor = over(value, pivot);
        for (const f of [beyond, within]) add(f, r, negative(times(factor, f[c])));
        for (const [s, other] of row) {
          if (s >= r) left[r].set(s, minus(left[r].get(s) ?? zero, times(factor, other)));
        }
      }
    });
    return [S, G];
  }

  const REGION = ["states", "center", "radius", "inverse"], NEAR = ["answer", "distance"];
  const REGIONS = [REGION, [...REGION, ...NEAR]].flatMap((keys) => [keys, [...keys, "redundant"]]);
  const KEYS = {
    "solution": [["x"], ["x", "answer", "distance"]], "unique": [["x", "by"]], "not-unique": [["x", "y"]],
    "cone-solution": REGIONS, "body-solution": [...REGIONS, ...REGIONS.map((keys) => [...keys, "bias_change"])], "no-solution": [["tree"]], "within": [["answer", "residual"]],
    "motion": [["answer", "motion", "bound"], ["answer", "motion", "bound", "force"]], "frozen-motion": [["answer", "motion", "bound"]],
  };

  function check(p, proof) {
    need(isObject(proof) && proof.format === "lcplab-proof-1", "another format");
    const known = typeof proof.kind === "string" && has(KEYS, proof.kind) ? KEYS[proof.kind] : [];
    const common = ["format", "problem", "kind", ...(has(proof, "model") ? ["model"] : [])];
    need(known.some((keys) => hasKeys(proof, [...common, ...keys])), "the keys of its kind");
    const model = has(proof, "model") ? proof.model : "coupled-box";
    need(model === p.model, `it is about another model than the problem's, ${p.model}`);
    need(proof.problem === p.hash, "it is about another problem");
    const answer = has(proof, "answer") ? list(proof.answer, p.n).map(number) : null;
    const isLeaf = proof.kind === "no-solution" && hasKeys(proof.tree, ["d"]);
    const isRegion = ["cone-solution", "body-solution"].includes(proof.kind);
    const isOfCone = (isRegion || ["solution", "not-unique"].includes(proof.kind)) && CONES.includes(model)
      || proof.kind === "motion" && model === "associated-cone";
    need(isLeaf || isOfCone || (BOXES.includes(model) && !isRegion), `of ${model} this is no proof`);
    const under = has(proof, "model") ? `, under the friction model ${model}` : "";
    return says(p, proof, answer) + under;
  }

  function says(p, proof, answer) {
    if (proof.kind === "no-solution") {
      tree(p, proof.tree, new Map());
      return "no solution exists";
    }
    if (proof.kind === "within") {
      need(hasKeys(proof.residual, ["numerator", "denominator"]), "a fraction");
      const [r, s] = [integer(proof.residual.numerator), integer(proof.residual.denominator)];
      const own = residual(p, answer);
      need(r >= 0n && s > 0n && r * own[1] === s * own[0], "the residual is another");
      return "the scaled residual of the answer is the fraction that it states";
    }
    if (proof.kind === "motion" || proof.kind === "frozen-motion") {
      const isFrozen = proof.kind !== "motion";
      const isCone = p.model === "associated-cone";
      need(isCone === has(proof, "force"), "the keys of its kind");
      need(isCone || isFrozen === p.owner.some((k) => k >= 0), "the kind for rows that are coupled is another");
      need(p.motion !== null, "the problem says nothing of bodies");
      const bound = binary(parts(size(proof.bound))), [S, G] = squares(p, answer, proof.motion, isCone ? forces(p, proof.force) : null);
      const rest = plus(times(bound, bound), negative(plus(S, G))), product = times([4n, 1n], times(S, G));
      need(rest[0] >= 0n && !less(times(rest, rest), product), "the motion shows a larger bound only");
      return `the motion of the answer is within ${proof.bound.value} of the exact one${isFrozen ? ", with frozen friction" : ""}`;
    }
    const isOfBodies = proof.kind === "body-solution", isRegion = isOfBodies || proof.kind === "cone-solution";
    const [x, R, D] = isRegion ? region(isOfBodies ? augmented(p) : p, proof) : solution(p, proof.x).toSpliced(1, 0, null);
    if (proof.kind === "unique") {
      unique(p, proof.by);
      return "exactly one solution exists";
    }
    if (proof.kind === "not-unique") {
      const [y, E] = solution(p, proof.y);
      need(x.some((v, i) => v * E !== y[i] * D), "both solutions are one");
      return "two different solutions exist";
    }
    const change = has(proof, "bias_change") ? `, with a bias that differs by at most ${proof.bias_change.value},` : "";
    const exists = `a solution exists${isOfBodies ? " for the exact numbers of the bodies" : ""}${change}`;
    if (answer === null) return exists;
    const [values, s] = whole([size(proof.distance), ...answer]), [distance, ...near] = values;
    const width = (i) => (R === null ? 0n : R[i] << s);
    need(near.every((v, i) => abs(v * D - (x[i] << s)) + width(i) <= distance * D), "the answer is farther away");
    return `${exists} within ${proof.distance.value} of the answer`;
  }

  const checked = (p, proofText) => {
    try {
      return { holds: true, says: check(p, read(proofText)) };
    } catch (error) {
      return { holds: false, says: error.message };
    }
  };
  const lcpcheck = (problemText, proofText, model) => checked(problem(read(problemText), model), proofText);
  // The same for many proofs: about the problem of its hash each.
  lcpcheck.all = (problemTexts, proofTexts) => {
    const problems = new Map(problemTexts.map((text) => problem(read(text))).map((p) => [p.hash, p]));
    const another = { holds: false, says: "it is about another problem" };
    const hash = (text) => { try { return JSON.parse(text).problem; } catch { return null; } };
    return proofTexts.map((text) => (problems.has(hash(text)) ? checked(problems.get(hash(text)), text) : another));
  };
  // Whether a problem can be read: it throws the reason if not.
  lcpcheck.problem = (text, model) => problem(read(text), model);
  return lcpcheck;
})();

if (typeof module !== "undefined") module.exports = lcpcheck;
if (typeof process !== "undefined" && typeof require !== "undefined" && require.main === module) {
  const fs = require("fs"), path = require("path"), given = process.argv.slice(2);
  const isFolder = given.length === 1 && fs.statSync(given[0], { throwIfNoEntry: false })?.isDirectory();
  if (!isFolder && given.length !== 2 && given.length !== 3) {
    console.log("usage: node lcpcheck.js PROBLEM.json PROOF.json [MODEL]  or  node lcpcheck.js FOLDER");
    process.exit(2);
  }
  const names = isFolder ? fs.readdirSync(given[0]).sort().map((name) => path.join(given[0], name)) : null;
  const proofs = names === null ? [given[1]] : names.filter((name) => name.endsWith(".proof.json"));
  const problems = names === null ? [given[0]] : names.filter((name) => name.endsWith(".json") && !proofs.includes(name));
  const decoder = new TextDecoder("utf-8", { fatal: true, ignoreBOM: true });
  const text = (name) => decoder.decode(fs.readFileSync(name));
  const readable = (name) => { try { return text(name); } catch { return ""; } };
  if (proofs.length === 0) {
    console.log(`${given[0]}: there is no *.proof.json in it`);
    process.exit(2);
  }
  for (const name of problems) {
    try {
      lcpcheck.problem(text(name), given[2]);
    } catch (error) {
      console.log(`${name}: cannot be read: ${error.message}`);
      process.exit(2);
    }
  }
  try {
    const found = names === null ? [lcpcheck(text(problems[0]), readable(proofs[0]), given[2])]
      : lcpcheck.all(problems.map(text), proofs.map(readable));
    found.forEach(({ holds, says }, k) => console.log(`${proofs[k]}: ${holds ? "proved" : "rejected"}: ${says}`));
    process.exitCode = found.every(({ holds }) => holds) ? 0 : 1;
  } catch (error) {
    console.log(`${problems.join(", ")}: cannot be read: ${error.message}`);
    process.exitCode = 2;
  }
}
