/** Exports and imports stored missions, through the control plane or past it. */
package io.furrow.cli.recording;
