/** What is played, as records of a replay's topic. */
package io.furrow.replay.record;
