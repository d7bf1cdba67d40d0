/** Starts, ends and lists the analytics jobs of replays together with these. */
package io.furrow.launcher.replay;
