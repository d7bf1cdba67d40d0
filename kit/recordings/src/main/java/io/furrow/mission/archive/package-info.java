/** Exports, imports and archives stored missions as files of lines on Flink's file systems, which callers provide. */
package io.furrow.mission.archive;
