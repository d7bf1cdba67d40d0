/** Stored images of missions: their names, and how many there are on Flink's file systems. */
package io.furrow.mission.image;
