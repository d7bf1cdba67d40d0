/** The control plane as one service: its managers together, their topics, their settings. */
package io.furrow.control;
