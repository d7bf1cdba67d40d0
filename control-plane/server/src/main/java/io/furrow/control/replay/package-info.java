/** Replays: asked for, answered, forwarded to whoever plays them back. */
package io.furrow.control.replay;
