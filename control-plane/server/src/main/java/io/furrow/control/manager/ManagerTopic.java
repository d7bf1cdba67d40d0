package io.furrow.control.manager;

import java.util.function.Function;
import java.util.stream.Stream;

import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.ParsedRequest;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.Requests;
import io.furrow.model.topic.Topics;

/**
 * The topic of a manager, for requests and answers.
 *
 * @param name prefix of the names of its stores and nodes; never changed, because state is found by it
 * @param <C> its commands
 */
public record ManagerTopic<C>(String name, String topic, Function<byte[], ParsedRequest<C>> reader) {
    public static final ManagerTopic<DomainCommand> DOMAIN =
            new ManagerTopic<>("domain", Topics.DOMAIN_MANAGER, Requests::domain);
    public static final ManagerTopic<MissionCommand> MISSION =
            new ManagerTopic<>("mission", Topics.MISSION_MANAGER, Requests::mission);
    public static final ManagerTopic<ReplayCommand> REPLAY =
            new ManagerTopic<>("replay", Topics.REPLAY_MANAGER, Requests::replay);
    public static final ManagerTopic<AlarmCommand> ALARM =
            new ManagerTopic<>("alarm", Topics.ALARM_MANAGER, Requests::alarm);

    static boolean isManager(String topic) {
        return Stream.of(DOMAIN, MISSION, REPLAY, ALARM)
                .anyMatch(each -> each.topic().equals(topic));
    }

    ParsedRequest<C> read(byte[] value) {
        return reader.apply(value);
    }

    public String answers() {
        return name + "-responses";
    }
}
