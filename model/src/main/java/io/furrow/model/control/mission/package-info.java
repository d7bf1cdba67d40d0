/** Commands, templates and devices of missions. */
package io.furrow.model.control.mission;
