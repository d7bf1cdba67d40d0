/** When which event of a replay is due: pure rules, without a clock, a thread or Flink. */
package io.furrow.replay.playback;
