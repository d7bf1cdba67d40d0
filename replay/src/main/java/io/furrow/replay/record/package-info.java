/** Composes the records of a replay's topic. */
package io.furrow.replay.record;
