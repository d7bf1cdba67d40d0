/** The whole suite started by one command. */
package io.furrow.launcher;
