/** Reads records of topics, and lists and redrives dead letters. */
package io.furrow.control.letter;
