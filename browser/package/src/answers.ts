// Options of predictions and queries.
import type { Probe } from "./asking.js";
import type { Filter } from "./filter.js";
import type { Keys } from "./options.js";
import type { BodyId } from "./state.js";

/** Whom a prediction or a query may ask. */
export interface AnswerOptions {
  /**
   * Is asked for the states of undecided bodies now, for an answer that is as good as fresh reports allow. Without one, the
   * answer follows from what the world knows. The world of a replay takes none.
   */
  probe?: Probe;
}
/** What World.safeUntil() may be told of two bodies. */
export interface PairOptions extends AnswerOptions {
  /** Length >= 0 between the surfaces; without one, the two are to touch. */
  distance?: number;
}
/** At which bodies a query looks: it passes through all others. */
export interface QueryOptions extends AnswerOptions {
  /** Those that a body with this filter may touch. */
  filter?: Filter;
  /** Not this one, such as the body that casts the ray. */
  except?: BodyId;
}
/** At which bodies many queries look. */
export interface QueriesOptions extends AnswerOptions {
  /** Those that a body with this filter may touch. */
  filter?: Filter;
  /** For each query one that it leaves out, such as the body that casts the ray. */
  except?: ArrayLike<BodyId>;
}
/** The distance of two surfaces is between these limits; infinite ones say that nothing is known. */
export interface Limits { lower: number; upper: number }

export const answerKeys: Keys<AnswerOptions> = { probe: true };
export const pairKeys: Keys<PairOptions> = { probe: true, distance: "number" };
export const queryKeys: Keys<QueryOptions> = { probe: true, filter: true, except: "number" };
export const queriesKeys: Keys<QueriesOptions> = { probe: true, filter: true, except: true };
