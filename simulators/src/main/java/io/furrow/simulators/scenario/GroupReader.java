package io.furrow.simulators.scenario;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import io.furrow.simulators.device.Registration;
import io.furrow.simulators.robot.Interruptions;
import io.furrow.simulators.robot.RobotModel;
import io.furrow.simulators.robot.Way;
import io.furrow.simulators.scenario.SimulatedDevice.Identity;
import io.furrow.simulators.scenario.SimulatedDevice.Place;
import io.furrow.simulators.scenario.SimulatedDevice.Quantity;
import io.furrow.simulators.signal.Draw;
import io.furrow.simulators.signal.Signal;
import io.furrow.simulators.signal.Span;
import io.furrow.simulators.signal.Weather;

/** Reads one entry of a mission's {@code devices}: a device, or a {@code count} of them that differ in place and seed. */
final class GroupReader {
    private static final long MOST_DEVICES = 100_000;
    private static final double COLDEST = -60;
    private static final double HOTTEST = 60;

    private final PlaceReader places;
    private final FaultReader faults;
    private final long seed;

    GroupReader(PlaceReader places, FaultReader faults, long seed) {
        this.places = places;
        this.faults = faults;
        this.seed = seed;
    }

    List<SimulatedDevice> devices(Members group, String domain, String mission) throws UnusableScenarioException {
        String type = group.text("type");
        String id = group.text("id");
        boolean many = group.has("count");
        long count = group.whole("count", 1, MOST_DEVICES, 1);
        String entity = group.text("entity", "urn:ngsi-ld:" + type + ":" + id);
        List<SimulatedDevice> devices = new ArrayList<>();
        for (long number = 1; number <= count; number++) {
            String end = many ? "-" + number : "";
            devices.add(device(group, new Identity(id + end, entity + end, type, domain, mission), number));
        }
        group.end();
        return devices;
    }

    private SimulatedDevice device(Members group, Identity identity, long number) throws UnusableScenarioException {
        Duration period = group.duration("period");
        if (period.isZero()) {
            throw group.refused("period", "must be longer than PT0S");
        }
        long own = Draw.seed(seed, identity.mission() + "/" + identity.id());
        return switch (identity.type()) {
            case "Thermometer" -> sensor(group, identity, number, thermometer(weather(group, own)));
            case "WeatherStation" -> sensor(group, identity, number, station(weather(group, own)));
            case "Camera" -> camera(group, identity, number);
            case "Robot" -> robot(group, identity, period, own);
            default ->
                throw group.refused(
                        "type",
                        "'%s' is no type of device; use Thermometer, WeatherStation, Camera or Robot"
                                .formatted(identity.type()));
        };
    }

    private SimulatedDevice sensor(Members group, Identity identity, long number, List<Quantity> sound)
            throws UnusableScenarioException {
        long own = Draw.seed(seed, identity.mission() + "/" + identity.id());
        List<String> names =
                sound.stream().map(quantity -> quantity.attribute().name()).toList();
        List<FaultReader.Wrong> wrongs = faults.faults(group, number, own, names);
        List<Quantity> shown = sound.stream()
                .map(quantity -> new Quantity(quantity.attribute(), faulty(quantity, wrongs)))
                .toList();
        return new SimulatedDevice.Sensor(identity, group.duration("period"), place(group, number, own), shown);
    }

    private SimulatedDevice camera(Members group, Identity identity, long number) throws UnusableScenarioException {
        long own = Draw.seed(seed, identity.mission() + "/" + identity.id());
        Double heading = group.has("heading") ? Double.valueOf(group.number("heading", 0, 360)) : null;
        List<Span> silent = faults.faults(group, number, own, List.of()).stream()
                .map(wrong -> wrong.fault().during())
                .toList();
        return new SimulatedDevice.Camera(
                identity, group.duration("period"), place(group, number, own), heading, silent);
    }

    private SimulatedDevice robot(Members group, Identity identity, Duration period, long own)
            throws UnusableScenarioException {
        Way way = places.way(group);
        RobotModel.Manners manners = new RobotModel.Manners(
                group.number("clearance", 0, 1000, 2),
                group.number("meeting", 0, 1000, 0),
                group.duration("patience", Duration.ofSeconds(20)));
        Interruptions interruptions = null;
        if (group.has("obstacles")) {
            Members json = group.object("obstacles");
            interruptions = new Interruptions(
                    atLeastAMillisecond(json, "every"),
                    atLeastAMillisecond(json, "stay"),
                    json.number("radius", 0, 100, 0.5),
                    Draw.seed(own, "obstacles"));
            json.end();
        }
        RobotModel model = new RobotModel(identity.id(), way, manners, interruptions);
        double driven = group.number("start", 0, 1e9, 0) / way.speed();
        return new SimulatedDevice.Robot(identity, period, model, driven, group.truth("tellsMission", true));
    }

    private static Duration atLeastAMillisecond(Members json, String name) throws UnusableScenarioException {
        Duration duration = json.duration(name);
        if (duration.toMillis() < 1) {
            throw json.refused(name, "must be at least PT0.001S");
        }
        return duration;
    }

    private Place place(Members group, long number, long own) throws UnusableScenarioException {
        if (!group.has("carriedBy")) {
            return places.place(group, Draw.seed(own, "place"));
        }
        PlaceReader.once(group, "area", "at", "route", "carriedBy");
        // A group may be carried by a group: the nth by the nth. Which of the two is meant is known when all devices
        // are.
        String carrier = group.text("carriedBy");
        return new Place(group.text("where", ""), null, group.has("count") ? carrier + "-" + number : carrier);
    }

    private static Weather weather(Members group, long own) throws UnusableScenarioException {
        return new Weather(group.number("meanCelsius", COLDEST, HOTTEST, 18), own);
    }

    private static Signal faulty(Quantity sound, List<FaultReader.Wrong> wrongs) {
        Signal signal = sound.signal();
        for (FaultReader.Wrong wrong : wrongs) {
            if (wrong.attribute() == null
                    || wrong.attribute().equals(sound.attribute().name())) {
                signal = wrong.fault().on(signal);
            }
        }
        return signal;
    }

    private static List<Quantity> thermometer(Weather weather) {
        return List.of(quantity("temp", "Temperature", weather.temperature()));
    }

    private static List<Quantity> station(Weather weather) {
        return List.of(
                quantity("temp", "Temperature", weather.temperature()),
                quantity("hum", "Humidity", weather.humidity()),
                quantity("press", "Pressure", weather.pressure()),
                quantity("wind", "WindSpeed", weather.windSpeed()),
                quantity("dir", "WindDirection", weather.windDirection()),
                quantity("rain", "Rain", weather.rain()),
                quantity("sun", "SolarRadiation", weather.radiation()));
    }

    private static Quantity quantity(String objectId, String name, Signal signal) {
        return new Quantity(new Registration.Attribute(objectId, name, "Float"), signal);
    }
}
