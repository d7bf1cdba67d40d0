/** Missions in files of lines, and their reader. */
package io.furrow.mission.file;
