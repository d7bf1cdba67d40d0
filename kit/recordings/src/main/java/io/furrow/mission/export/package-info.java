/** Recordings in the formats of other tools. */
package io.furrow.mission.export;
