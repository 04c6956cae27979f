// Moments as the program writes them: dates of the data's calendar where the unit of time has one, else numbers
// (index/volume/calendar.cpp, time_unit.cpp and instant_text.cpp).

type Calendar = "standard" | "proleptic_gregorian" | "julian" | "noleap" | "all_leap" | "360_day";
const CALENDARS: Record<string, Calendar> = {
  "": "standard", standard: "standard", gregorian: "standard", proleptic_gregorian: "proleptic_gregorian", julian: "julian", noleap: "noleap", no_leap: "noleap",
  "365_day": "noleap", all_leap: "all_leap", "366_day": "all_leap", "360_day": "360_day", thirty_day_months: "360_day",
};
const [FIRST_YEAR, LAST_YEAR] = [-9999, 99999];
const DAY = 86400; // seconds
const FRACTIONS = 65536;
const DAYS = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
/** Seconds of units by their names. */
const SECONDS: Record<string, number> = Object.fromEntries(
  ([["common_year common_years", 365 * DAY], ["week weeks", 7 * DAY], ["d day days", DAY], ["h hr hrs hour hours", 3600], ["min mins minute minutes", 60], ["s sec secs second seconds", 1],
    ["ms msec msecs millisecond milliseconds", 1e-3], ["us usec usecs microsecond microseconds", 1e-6]] as const).flatMap(([names, seconds]) => names.split(" ").map((name) => [name, seconds])),
);
const MONTHS: Record<string, number> = { month: 1, months: 1, mon: 1, mons: 1, year: 12, years: 12, yr: 12, yrs: 12 };
const lookUp = <T>(table: Record<string, T>, name: string): T | undefined => (Object.hasOwn(table, name) ? table[name] : undefined);

interface Day {
  year: number;
  month: number;
  day: number;
}
const isLeap = (year: number, calendar: Calendar): boolean =>
  calendar === "all_leap" || (calendar === "julian" && year % 4 === 0) ||
  ((calendar === "standard" || calendar === "proleptic_gregorian") && year % 4 === 0 && (year % 100 !== 0 || year % 400 === 0));
const daysIn = (month: number, year: number, calendar: Calendar): number => (calendar === "360_day" ? 30 : DAYS[month - 1]! + Number(month === 2 && isLeap(year, calendar)));

/** Days from 1970-01-01 of the Gregorian calendar, or from the calendar's year 0, to January 1st of a year. */
function daysBefore(year: number, calendar: Calendar): number {
  const multiples = (of: number) => Math.floor((year - 1) / of) + 1;
  if (calendar === "360_day") return 360 * year;
  if (calendar === "noleap") return 365 * year;
  if (calendar === "all_leap") return 366 * year;
  if (calendar === "julian") return 365 * year + multiples(4) - 719530;
  return 365 * year + multiples(4) - multiples(100) + multiples(400) - 719528;
}
/** The first Gregorian day of the standard calendar, 1582-10-15. */
const REFORM = daysBefore(1582, "proleptic_gregorian") + 287;

/** @return null: the calendar has no such date, or the year is too far away */
function dayNumber({ year, month, day }: Day, calendar: Calendar): number | null {
  if (calendar === "standard") {
    const julian = year < 1582 || (year === 1582 && month * 100 + day < 1015);
    if (year < 1 || (julian && year === 1582 && month === 10 && day > 4)) return null;
    return dayNumber({ year, month, day }, julian ? "julian" : "proleptic_gregorian");
  }
  if (year < FIRST_YEAR || year > LAST_YEAR || month < 1 || month > 12 || day < 1 || day > daysIn(month, year, calendar)) return null;
  let days = daysBefore(year, calendar) + day - 1;
  for (let before = 1; before < month; ++before) days += daysIn(before, year, calendar);
  return days;
}
function dateOf(day: number, calendar: Calendar): Day | null {
  if (calendar === "standard") {
    const date = dateOf(day, day < REFORM ? "julian" : "proleptic_gregorian");
    return date && date.year > 0 ? date : null;
  }
  if (!(day >= daysBefore(FIRST_YEAR, calendar) && day < daysBefore(LAST_YEAR + 1, calendar))) return null;
  let year = FIRST_YEAR;
  for (let end = LAST_YEAR + 1; end - year > 1; ) {
    const middle = Math.floor((year + end) / 2);
    if (daysBefore(middle, calendar) <= day) year = middle;
    else end = middle;
  }
  let left = day - daysBefore(year, calendar);
  let month = 1;
  for (; left >= daysIn(month, year, calendar); ++month) left -= daysIn(month, year, calendar);
  return { year, month, day: left + 1 };
}

interface Unit {
  /** 0: a unit of months. */
  seconds: number;
  months: number;
  date: Day;
  /** Number of the reference date's day, and seconds since its midnight. */
  day: number;
  clock: number;
  calendar: Calendar;
}
const DATED =
  /^(\w+) +since +(-?\d{1,5})-(\d{1,2})-(\d{1,2})(?:[T ]+(\d{1,2})(?::(\d{1,2})(?::(\d{1,2}(?:\.\d*)?))?)?)? *(?:Z|UTC|GMT)?(?: *([+-])(\d{1,2})(?::?(\d{2}))?)?(?: \((\w+)\))?$/i;

/** A unit with a reference date; null: it is none. */
function unitOf(text: string): Unit | null {
  const part = text.length > 200 ? null : DATED.exec(text);
  if (!part) return null;
  const number = (i: number) => Number(part[i] ?? 0);
  let calendar = lookUp(CALENDARS, (part[11] ?? "").toLowerCase());
  if (!calendar) return null;
  const date = { year: number(2), month: number(3), day: number(4) };
  const day = dayNumber(date, calendar);
  const name = part[1]!.toLowerCase();
  const months = lookUp(MONTHS, name) ?? 0;
  // Months and years are as long as others only where all of them are equally long.
  const whole = calendar === "360_day" ? months * 30 : months === 12 && calendar === "noleap" ? 365 : months === 12 && calendar === "all_leap" ? 366 : 0;
  const seconds = months === 0 ? lookUp(SECONDS, name) : whole * DAY;
  if (seconds === undefined || day === null || number(5) > 24 || number(6) > 60 || number(7) > 61) return null;
  if (calendar === "proleptic_gregorian" && date.year >= 1583) calendar = "standard";
  const zone = (part[8] === "-" ? -1 : 1) * (number(9) * 3600 + number(10) * 60);
  return { seconds, months: seconds ? 0 : months, date, day, clock: number(5) * 3600 + number(6) * 60 + number(7) - zone, calendar };
}

/** The day of a date so many months later: the month's last day where the month is shorter. */
function monthsLater(date: Day, months: number, calendar: Calendar): number | null {
  const all = date.year * 12 + date.month - 1 + months;
  const [year, month] = [Math.floor(all / 12), all - Math.floor(all / 12) * 12 + 1];
  for (let day = date.day; day >= 28 || day === date.day; --day) {
    const found = dayNumber({ year, month, day }, calendar);
    if (found !== null) return found;
  }
  return null;
}
/** Halves go away from 0. */
const rounded = (value: number): number => Math.sign(value) * Math.round(Math.abs(value));

interface Moment {
  date: Day;
  /** Since midnight. */
  milliseconds: number;
}
function momentOf(time: number, unit: Unit): Moment | null {
  let day: number;
  let seconds: number;
  if (unit.months === 0) {
    const whole = Math.floor((time * unit.seconds) / DAY);
    if (!(Math.abs(whole) < 1e8)) return null;
    [day, seconds] = [unit.day + whole, time * unit.seconds - whole * DAY + unit.clock];
  } else {
    const units = Math.floor(time);
    if (!(Math.abs(units) * unit.months < 2e6)) return null;
    const [begin, end] = [0, unit.months].map((more) => monthsLater(unit.date, units * unit.months + more, unit.calendar)) as [number | null, number | null];
    if (begin === null || end === null) return null;
    [day, seconds] = [begin, (time - units) * (end - begin) * DAY + unit.clock];
  }
  const all = rounded(seconds * 1000);
  const more = Math.floor(all / (DAY * 1000));
  const date = dateOf(day + more, unit.calendar);
  return date && { date, milliseconds: all - more * DAY * 1000 };
}

/** A date, with so many parts of the time of day as one of these moments needs: hours and minutes, seconds, milliseconds. */
function dateText(of: readonly Moment[], { date, milliseconds }: Moment, calendar: Calendar): string {
  const parts = Math.max(...of.map(({ milliseconds: ms }) => (ms % 1000 ? 3 : ms % 60000 ? 2 : ms ? 1 : 0)));
  const two = (n: number) => String(Math.floor(n)).padStart(2, "0");
  const year = date.year < 0 ? `-${String(-date.year).padStart(3, "0")}` : String(date.year).padStart(4, "0");
  let text = `${year}-${two(date.month)}-${two(date.day)}`;
  if (parts > 0) text += ` ${two(milliseconds / 3600000)}:${two((milliseconds / 60000) % 60)}`;
  if (parts > 1) text += `:${two((milliseconds / 1000) % 60)}`;
  if (parts > 2) text += `.${String(milliseconds % 1000).padStart(3, "0")}`;
  return calendar === "standard" ? text : `${text} (${calendar})`;
}

/** A number with so many digits as `%.*g` writes it. */
function general(value: number, digits: number): string {
  if (!Number.isFinite(value) || value === 0) return Object.is(value, -0) ? "-0" : String(value);
  // Exact halves go to the even digit.
  const [mantissa] = value.toExponential(60).split("e") as [string];
  const all = mantissa.replace(/[-.]/g, "");
  const even = /^50*$/.test(all.slice(digits)) && Number(all[digits - 1]) % 2 === 0;
  const text = even ? Number(`${mantissa.slice(0, mantissa.indexOf(".") + digits)}e${value.toExponential(60).split("e")[1]!}`).toExponential(digits - 1) : value.toExponential(digits - 1);
  const [number, power] = text.split("e") as [string, string];
  const exponent = Number(power);
  const bare = (each: string) => (each.includes(".") ? each.replace(/\.?0+$/, "") : each);
  if (exponent < -4 || exponent >= digits) return `${bare(number)}e${exponent < 0 ? "-" : "+"}${String(Math.abs(exponent)).padStart(2, "0")}`;
  return bare(Number(text).toFixed(Math.min(100, digits - 1 - exponent)));
}

/** A time among those before and after it, where there are such. */
function timeText(around: readonly number[], at: number, unit: string): string {
  const dated = unitOf(unit);
  const moments = dated ? around.map((time) => momentOf(time, dated)) : [null];
  if (moments.every((each): each is Moment => each !== null)) return dateText(moments, moments[at]!, dated!.calendar);
  // As few digits as tell it from the others.
  let text = "";
  for (let digits = 6; digits <= 17; ++digits) {
    text = general(around[at]!, digits);
    if (around.filter((time) => general(time, digits) === text).length <= 1) break;
  }
  return unit === "" ? text : `${text} ${unit}`;
}

/** From a to b as std::lerp goes. */
function between(a: number, b: number, share: number): number {
  if (a <= 0 !== b <= 0 || a === 0 || b === 0) return share * b + (1 - share) * a;
  const at = a + share * (b - a);
  return b > a ? Math.min(at, b) : Math.max(at, b);
}
/** To the second, minute or the like that is finer than a 500th of what lies between the steps. */
function writtenTime(before: number, time: number, after: number, unit: string): number {
  const end = unit.indexOf(" since ");
  const seconds = end < 0 ? undefined : lookUp(SECONDS, unit.slice(0, end));
  if (seconds === undefined) return time;
  const step = [3600, 60, 1, 0.1, 0.01, 0.001].find((each) => 500 * each <= (after - before) * seconds);
  if (step === undefined) return time;
  const near = (rounded((time * seconds) / step) * step) / seconds;
  return before < near && near < after ? near : time;
}

/** When a moment is, for people: `2009-09-09 17:00`, `2000-02-30 (360_day)`, `0.25 s`. @param times of all steps @param fraction so many 65536ths of the way to the next step */
export function momentText(times: readonly number[], step: number, fraction: number, unit: string): string {
  const [time, after] = [times[step]!, times[step + 1]];
  if (fraction && after !== undefined) return timeText([time, writtenTime(time, between(time, after, fraction / FRACTIONS), after, unit), after], 1, unit);
  return timeText(times.slice(Math.max(0, step - 1), step + 2), step > 0 ? 1 : 0, unit);
}
