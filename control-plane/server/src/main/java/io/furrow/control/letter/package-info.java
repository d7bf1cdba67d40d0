/** Lists, reads and redrives dead letters. */
package io.furrow.control.letter;
