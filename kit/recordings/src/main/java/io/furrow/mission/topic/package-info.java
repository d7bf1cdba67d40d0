/** Kafka topics that are read as recordings. */
package io.furrow.mission.topic;
