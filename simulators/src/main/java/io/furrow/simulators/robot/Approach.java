package io.furrow.simulators.robot;

import org.locationtech.jts.geom.Coordinate;

/** When somebody who goes straight on comes near a place. */
final class Approach {
    private Approach() {}

    /** Metres from {@code here} towards {@code end} until the place is within {@code distance}; -1 where it never is on this stretch. */
    static double metersUntil(Coordinate here, Coordinate end, Coordinate place, double distance) {
        if (here.distance(place) <= distance) {
            return 0;
        }
        double length = here.distance(end);
        if (length == 0) {
            return -1;
        }
        double alongX = (end.x - here.x) / length;
        double alongY = (end.y - here.y) / length;
        double ahead = (place.x - here.x) * alongX + (place.y - here.y) * alongY;
        double aside = Math.abs((place.x - here.x) * alongY - (place.y - here.y) * alongX);
        if (aside > distance) {
            return -1;
        }
        double reached = ahead - Math.sqrt(distance * distance - aside * aside);
        return reached >= 0 && reached <= length ? reached : -1;
    }
}
