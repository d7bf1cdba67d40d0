/** Replays: asked for, answered, handed on to whoever plays them back. */
package io.furrow.control.replay;
