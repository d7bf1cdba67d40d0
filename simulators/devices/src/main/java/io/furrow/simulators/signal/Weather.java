package io.furrow.simulators.signal;

import java.time.Duration;
import java.time.Instant;
import java.util.OptionalDouble;

/**
 * The weather at one place. Its quantities are consistent (the air is driest when it is warmest, the sun shines by day)
 * and depend on seed and time only.
 *
 * @param meanCelsius mean temperature of the day
 */
public record Weather(double meanCelsius, long seed) {
    private static final double SWING = 6;
    private static final double DEW_POINT_BELOW_MEAN = 8;
    private static final double SUNRISE = 6;
    private static final double DAYLIGHT = 12;
    private static final double BRIGHTEST = 950;
    private static final double SHOWER_SHARE = 0.08;

    /** Air temperature, °C. */
    public Signal temperature() {
        return air().plus(Curves.noise(0.15, part("temperature"))).rounded(2);
    }

    /** Relative humidity, %: that of air whose dew point stays the same all day (Magnus formula, Alduchov and Eskridge 1996). */
    public Signal humidity() {
        double vapour = saturation(meanCelsius - DEW_POINT_BELOW_MEAN);
        Signal dry = time -> OptionalDouble.of(100 * vapour / saturation(value(air(), time)));
        return dry.plus(Curves.noise(0.4, part("humidity"))).within(0, 100).rounded(1);
    }

    /** Air pressure, hPa. */
    public Signal pressure() {
        Signal mean = time -> OptionalDouble.of(1013.25);
        return mean.plus(Curves.wandering(15, Duration.ofHours(12), part("pressure")))
                .rounded(1);
    }

    /** Wind speed, m/s. */
    public Signal windSpeed() {
        Signal mean = time -> OptionalDouble.of(3.5);
        return mean.plus(Curves.wandering(3, Duration.ofMinutes(40), part("wind")))
                .plus(Curves.wandering(1.5, Duration.ofSeconds(8), part("gusts")))
                .within(0, 40)
                .rounded(1);
    }

    /** Direction from which the wind blows, degrees clockwise from north, 0 to below 360. */
    public Signal windDirection() {
        Signal wind = Curves.wandering(180, Duration.ofHours(3), part("direction"));
        return time -> OptionalDouble.of(Math.floorMod(Math.round(value(wind, time)), 360));
    }

    /** Rain, mm/h; mostly 0. */
    public Signal rain() {
        Signal shower = Curves.wandering(1, Duration.ofMinutes(30), part("rain"));
        Signal fall = time -> OptionalDouble.of(20 * (value(shower, time) - (1 - 2 * SHOWER_SHARE)));
        return fall.within(0, 60).rounded(1);
    }

    /** Solar radiation, W/m²: 0 at night, at most at 12:00 UTC, less under clouds. */
    public Signal radiation() {
        Signal clouds = Curves.wandering(0.25, Duration.ofMinutes(5), part("clouds"));
        Signal sun = time -> OptionalDouble.of(BRIGHTEST
                * Math.max(0, Math.sin(Math.PI * (Curves.hour(time) - SUNRISE) / DAYLIGHT))
                * (0.75 + value(clouds, time)));
        return sun.rounded(0);
    }

    private Signal air() {
        return Curves.diurnal(meanCelsius, SWING).plus(Curves.wandering(0.5, Duration.ofHours(1), part("air")));
    }

    private long part(String name) {
        return RandomStream.seed(seed, name);
    }

    private static double value(Signal signal, Instant time) {
        return signal.at(time).orElseThrow();
    }

    /** Pressure of saturated vapour, hPa. */
    private static double saturation(double celsius) {
        return 6.1094 * Math.exp(17.625 * celsius / (celsius + 243.04));
    }
}
