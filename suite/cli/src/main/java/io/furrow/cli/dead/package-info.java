/** Redrives dead letters. */
package io.furrow.cli.dead;
