/** A comparison as text, table, JSON and SVG. */
package io.furrow.cli.compare.report;
