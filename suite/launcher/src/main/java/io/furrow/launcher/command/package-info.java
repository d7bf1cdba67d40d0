/** The commands that start the suite or one of its parts, and those that read its topics and stores. */
package io.furrow.launcher.command;
