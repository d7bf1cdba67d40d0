/**
 * The fields of the farm, as they are at each event's time; what a job uses that asks where a device is.
 *
 * <p>A job's options mix {@link io.furrow.analytics.field.FieldOptions} in ({@code --fields}, {@code --fields-topic}). Its
 * {@code assemble} makes a {@link io.furrow.analytics.field.FieldInput}; a test makes one of its own. Its page reads
 *
 * <pre>{@code
 * SingleOutputStreamOperator<TopicRecord> fields = in.fields()
 *         .records()
 *         .process(new ParseFields("presence"))
 *         .setParallelism(1) // a version's records stay in order
 *         .uid("recognize-fields")
 *         .name("Recognize fields");
 *
 * fixes.connect(fields.broadcast())
 *         .transform(name, type, new TimelessBroadcastOperator<>(new JoinWithFields(in.fields().atStart()), List.of(FieldVersions.BROADCAST)))
 * }</pre>
 *
 * and its output takes {@code fields.getSideOutput(DeadLetters.TAG)} in. The function that joins is a {@code
 * BroadcastProcessFunction}, or a {@code KeyedBroadcastProcessFunction} where it keeps something of each device, and holds a {@link
 * io.furrow.analytics.field.FieldVersions}: {@code known = FieldVersions.read(atStart)} in {@code open}, {@code known.take(record)}
 * for each broadcast record, {@code known.covering(position, time)} for each event. It keeps nothing of the fields
 * in Flink's state.
 *
 * <p>Which fields cover a place changes also while a device says nothing: {@code known.nextChange(time)} says when any field
 * next begins, changes or ends, {@code known.at(id, time)} what one is like then. A version that comes after an event of its
 * time has passed is too late for that event; {@code known.take} says whether a record changed anything.
 */
package io.furrow.analytics.field;
