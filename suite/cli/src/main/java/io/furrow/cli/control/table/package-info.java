/** Input files and output tables of the control commands. */
package io.furrow.cli.control.table;
