package io.furrow.analytics.temperature;

import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.TreeMap;
import java.util.function.IntToDoubleFunction;
import java.util.stream.IntStream;

import io.furrow.analytics.Seeds;

/**
 * Windows of a field in which sound devices vote normally distributed around one temperature, and maybe some that are off by a
 * number of standard deviations. The temperature is anywhere between two steps to which votes are rounded, again in each trial.
 *
 * @param trials of each share
 * @param floor option of the job
 */
record SuspectSimulation(int trials, double floor) {
    /** Standard deviation of sound votes, degrees Celsius. */
    static final double SIGMA = 0.3;

    static final List<Integer> DEVICES = IntStream.rangeClosed(3, 20).boxed().toList();

    /** Of the default floor; {@code -Dfurrow.suspect.trials} makes it more. */
    static SuspectSimulation byDefault() {
        int trials = Integer.getInteger("furrow.suspect.trials", 10_000);
        return new SuspectSimulation(trials, Farm.options(Farm.FIELDS).suspectFloor());
    }

    /** The share of windows in which a sound device is named, none being off: by number of devices. */
    Map<Integer, Double> soundNamed(double step) {
        return byDevices(devices -> soundNamed(devices, SIGMA, step));
    }

    /** The share of windows in which a sound device is named, none being off. */
    double soundNamed(int devices, double sigma, double step) {
        Random random = random(devices, sigma, step, 0);
        int named = 0;
        for (int trial = 0; trial < trials; trial++) {
            named += suspects(random, devices, sigma, step, random.nextDouble()).isEmpty() ? 0 : 1;
        }
        return (double) named / trials;
    }

    /** The share of trials in which a device that is so many standard deviations off is named in one of this many windows. */
    Map<Integer, Double> namedWithin(int windows, double off, double step) {
        return byDevices(devices -> namedWithin(windows, devices, step, off));
    }

    /** The share of trials in which all devices that are off by this many standard deviations are named in one of the windows. */
    double namedWithin(int windows, int devices, double step, double... off) {
        List<String> desired = IntStream.range(0, off.length)
                .mapToObj(SuspectSimulation::name)
                .sorted()
                .toList();
        Random random = random(devices, SIGMA, step, off.length);
        int named = 0;
        for (int trial = 0; trial < trials; trial++) {
            double place = random.nextDouble();
            for (int window = 0; window < windows; window++) {
                if (suspects(random, devices, SIGMA, step, place, off).containsAll(desired)) {
                    named++;
                    break;
                }
            }
        }
        return (double) named / trials;
    }

    /** @param place of the temperature between two steps, 0 to 1 */
    private List<String> suspects(Random random, int devices, double sigma, double step, double place, double... off) {
        Map<String, Double> votes = new HashMap<>();
        for (int device = 0; device < devices; device++) {
            double bias = device < off.length ? off[device] : 0;
            double vote = place * step + sigma * (random.nextGaussian() + bias);
            votes.put(name(device), step == 0 ? vote : Math.rint(vote / step) * step);
        }
        return RobustMean.of(votes, floor).suspects();
    }

    private static String name(int device) {
        return "t" + device;
    }

    private static Random random(int devices, double sigma, double step, int off) {
        return Seeds.random(List.of(devices, sigma, step, off).hashCode());
    }

    private static Map<Integer, Double> byDevices(IntToDoubleFunction share) {
        Map<Integer, Double> shares = new TreeMap<>();
        DEVICES.forEach(devices -> shares.put(devices, share.applyAsDouble(devices)));
        return shares;
    }
}
