/** A farm's year in an hour: missions that come and go, restarts, kills and power cuts, and what has grown by the end. */
package io.furrow.soak.year;
