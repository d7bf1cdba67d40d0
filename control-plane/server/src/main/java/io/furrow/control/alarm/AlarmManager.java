package io.furrow.control.alarm;

import java.util.List;

import io.furrow.control.manager.ManagerTopic;
import io.furrow.control.manager.ManagerTopology;
import io.furrow.control.manager.Sequence;
import io.furrow.control.manager.UnitOfWork;

/**
 * Processes requests on {@code service.alarmmanager} and maintains {@code service.alarms}. All processors that raise
 * alarms share its stores, in one task.
 */
public final class AlarmManager {
    /** Store of the suspects of each field, by field. */
    public static final String SUSPECTS = "suspect-streaks";

    private static final String ALARMS = "alarms";
    private static final String CURRENT = "current-alarms";
    private static final String MUTES = "alarm-mutes";
    private static final String SEQUENCE = "alarm-sequence";
    private static final String GROUPS = "alarm-groups";
    private static final String COUNTED = "alarm-overflow";

    private AlarmManager() {}

    /** Names of the stores that users of {@link #handler} need. */
    public static List<String> stores() {
        return List.of(ALARMS, CURRENT, MUTES, SEQUENCE, GROUPS, COUNTED, SUSPECTS);
    }

    /** Creates a handler on the stores of a processor. */
    public static AlarmCommandHandler handler(UnitOfWork unitOfWork) {
        AlarmTables tables = new AlarmTables(
                unitOfWork.table(ALARMS, Alarm.class),
                unitOfWork.table(CURRENT, String.class),
                unitOfWork.table(MUTES, AlarmTables.Mute.class),
                unitOfWork.table(GROUPS, AlarmLimit.Group.class),
                unitOfWork.table(COUNTED, AlarmLimit.Overflow.class));
        return new AlarmCommandHandler(tables, new Sequence(unitOfWork.table(SEQUENCE, Long.class)), unitOfWork);
    }

    public static void add(ManagerTopology topology) {
        topology.addStores(stores());
        topology.addManager(ManagerTopic.ALARM, AlarmManager::handler, stores());
    }
}
