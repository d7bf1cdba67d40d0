/**
 * A farm's year in an hour: missions start and end, the suite is restarted, killed and loses power; checks results and
 * growth.
 */
package io.furrow.soak.year;
