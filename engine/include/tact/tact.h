// The whole public interface of tact. Start at World.
#pragma once

#include <tact/body.h>
#include <tact/body_queries.h>
#include <tact/contact_sums.h>
#include <tact/debug_draw.h>
#include <tact/error.h>
#include <tact/executor.h>
#include <tact/joined_minima.h>
#include <tact/kept_report.h>
#include <tact/message.h>
#include <tact/motion.h>
#include <tact/queries.h>
#include <tact/recording.h>
#include <tact/report.h>
#include <tact/report_arrays.h>
#include <tact/rotation.h>
#include <tact/settings.h>
#include <tact/statistics.h>
#include <tact/surface_check.h>
#include <tact/version.h>
#include <tact/weld.h>
#include <tact/world.h>
#include <tact/world_observer.h>
