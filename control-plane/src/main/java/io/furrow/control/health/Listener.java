package io.furrow.control.health;

import java.time.Duration;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import io.furrow.model.device.WantedDevice;
import io.furrow.model.ngsi.Entity;

/**
 * Listens to what devices report and tells when one is heard for the first time, then every 30 seconds, and when one has been
 * silent for too long: of ten thousand devices some hundred signs a second are left. Silence is measured by the clock of the
 * control plane, so that neither a device's clock nor reports that are read late make it.
 *
 * <p>A report with the event time of the last is none: the context broker tells the entity as it was when somebody sends it a
 * command.
 */
final class Listener {
    static final Duration SIGN_EVERY = Duration.ofSeconds(30);

    /** Boolean; false where the device is switched off. */
    static final String STATUS = "Status";

    private static final Duration LONGEST_TICK = Duration.ofSeconds(2);
    private static final Duration LOOKED_UP_EVERY = Duration.ofSeconds(5);

    private final HealthOptions options;
    private final WantedDevices wanted;
    private final Told told;
    private final Map<String, Heard> devices = new HashMap<>();
    private final Set<String> unwanted = new HashSet<>();
    private long lookedUp;
    private long passed;

    /** Takes what there is to tell of a device. */
    interface Told {
        /** @param key of {@code service.devices} */
        void tell(String key, Sign sign);
    }

    /** What is known of one device, changed with each report. */
    private static final class Heard {
        /** Null until it reports. */
        private Sign newest;

        private long told;
        private boolean silent;
        private long silentAfter;
    }

    Listener(HealthOptions options, WantedDevices wanted, Told told) {
        this.options = options;
        this.wanted = wanted;
        this.told = told;
    }

    /** Whether reports of a device matter at all: then they are worth reading. */
    boolean listensTo(String key) {
        if (devices.containsKey(key)) {
            return true;
        }
        if (unwanted.contains(key)) {
            return false;
        }
        Heard unheard = new Heard();
        boolean listens = isWantedStill(key, unheard);
        if (listens) {
            devices.put(key, unheard);
        } else {
            unwanted.add(key);
        }
        return listens;
    }

    /**
     * A device reported that is listened to.
     *
     * @param reported event time, epoch ms
     * @param now epoch ms
     * @return whether that is a sign of life
     */
    boolean hear(String key, Entity entity, long reported, long now) {
        Heard known = devices.get(key);
        boolean first = known.newest == null;
        if (!first && known.newest.reported() == reported) {
            return false;
        }
        Double battery = Battery.chargeOf(entity);
        boolean off = entity.value(STATUS)
                .filter(status -> status.isBoolean() && !status.booleanValue())
                .isPresent();
        boolean switched = !first && off != known.newest.off();
        Double newest = battery == null && !first ? known.newest.battery() : battery;
        known.newest = new Sign(entity.id(), entity.type(), false, now, reported, newest, off);
        if (first || known.silent || switched || now - known.told >= SIGN_EVERY.toMillis()) {
            known.told = now;
            known.silent = false;
            told.tell(key, known.newest);
        }
        return true;
    }

    /** Called about once a second. After a pause, in which reports were not read either, nobody is judged before they are. */
    void passTime(long now) {
        boolean paused = now - passed > LONGEST_TICK.toMillis();
        passed = now;
        if (now - lookedUp >= LOOKED_UP_EVERY.toMillis()) {
            lookedUp = now;
            unwanted.clear();
            devices.entrySet().removeIf(entry -> !isWantedStill(entry.getKey(), entry.getValue()));
        }
        if (!paused) {
            tellSilent(now);
        }
    }

    private void tellSilent(long now) {
        devices.forEach((key, heard) -> {
            if (!heard.silent
                    && heard.newest != null
                    && !heard.newest.off()
                    && now - heard.newest.heard() > heard.silentAfter) {
                heard.silent = true;
                told.tell(key, silence(heard.newest));
            }
        });
    }

    private boolean isWantedStill(String key, Heard heard) {
        Optional<WantedDevice> device = wanted.of(key);
        device.ifPresent(found -> heard.silentAfter = options.silentAfter(found));
        return device.isPresent();
    }

    private static Sign silence(Sign last) {
        return new Sign(last.id(), last.type(), true, last.heard(), last.reported(), last.battery(), last.off());
    }
}
