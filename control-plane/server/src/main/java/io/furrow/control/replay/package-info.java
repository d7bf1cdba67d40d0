/** Manages replays: commands, their desired state for the players, and the cleanup of their topics. */
package io.furrow.control.replay;
