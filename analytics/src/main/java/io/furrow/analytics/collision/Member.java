package io.furrow.analytics.collision;

/**
 * A device in a grid cell.
 *
 * @param fix where it is
 * @param resident whether it stands in the cell; else the cell has a halo copy of it
 * @param x component of the unit vector from the Earth's centre to it, towards 0° N 0° E
 * @param y component towards 0° N 90° E
 * @param z component towards the north pole
 */
public record Member(PositionFix fix, boolean resident, double x, double y, double z) {
    public static Member of(PositionFix fix, boolean resident) {
        double phi = Math.toRadians(fix.latitude());
        double lambda = Math.toRadians(fix.longitude());
        double cosine = Math.cos(phi);
        return new Member(fix, resident, cosine * Math.cos(lambda), cosine * Math.sin(lambda), Math.sin(phi));
    }
}
