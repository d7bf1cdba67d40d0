/** Stored missions as files of lines on Flink's file systems, which whoever uses them brings: exported, imported, archived. */
package io.furrow.mission.archive;
